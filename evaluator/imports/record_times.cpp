#include "evaluator/imports/record_times.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "evaluator/imports/play_statistics.hpp"

namespace trivela::evaluator::imports {
namespace {

constexpr double kLongestStep_ms = 2000.0;  // a stamp that moves by more says nothing of the time between records

/// Records between two resets of the game time, [from, to), with that time as it counts: never falling within.
struct Part {
  std::size_t from = 0, to = 0;
};

double stamp_step_ms(const TeamRecord& before, const TeamRecord& record) {
  if (!before.timestamp_ms || !record.timestamp_ms) return 0.0;
  const double step_ms = *record.timestamp_ms - *before.timestamp_ms;
  return step_ms > 0.0 && step_ms <= kLongestStep_ms ? step_ms : 0.0;
}

/// Game times with what is missing filled in, by record; `parts` is filled, too.
std::vector<double> game_times_ms(const TeamLog& log, std::vector<Part>& parts) {
  std::vector<double> times_ms;
  std::optional<double> reported_ms;  // the latest that the box wrote
  for (std::size_t i = 0; i < log.usable.size(); ++i) {
    const TeamRecord& record = log.usable[i];
    const bool falls = record.game_ms && reported_ms && *record.game_ms < *reported_ms;
    if (i == 0 || falls) {
      if (!parts.empty()) parts.back().to = i;
      parts.push_back({i, log.usable.size()});
      times_ms.push_back(record.game_ms.value_or(0.0));
    } else {
      const bool moved = record.game_ms && (!reported_ms || *record.game_ms > *reported_ms);
      const double by_stamp_ms = times_ms.back() + stamp_step_ms(log.usable[i - 1], record);
      times_ms.push_back(moved ? std::max(*record.game_ms, times_ms.back()) : by_stamp_ms);
    }
    if (record.game_ms) reported_ms = record.game_ms;
  }
  return times_ms;
}

/// UTC at which the game time of a part was 0, by the stamps that moved on. None: none did.
std::optional<double> offset_by_stamps_ms(const TeamLog& log, const Part& part, const std::vector<double>& times_ms) {
  std::vector<double> offsets_ms;
  for (std::size_t i = part.from + 1; i < part.to; ++i) {
    if (stamp_step_ms(log.usable[i - 1], log.usable[i]) > 0.0)
      offsets_ms.push_back(*log.usable[i].timestamp_ms - times_ms[i]);
  }
  return median(std::move(offsets_ms));
}

/// The same of the parts of the referee's log, in their order.
struct RefereePart {
  double offset_ms = 0.0;
  double longest_ms = 0.0;  ///< greatest game time
};

std::vector<RefereePart> referee_parts(const RefereeLog& log) {
  std::vector<RefereePart> parts;
  std::int64_t last_ms = 0;
  for (const RefereeLine& line : log.lines) {
    if (parts.empty() || line.game_ms < last_ms) parts.push_back({static_cast<double>(line.t_ms - line.game_ms), 0.0});
    last_ms = line.game_ms;
    parts.back().longest_ms = static_cast<double>(line.game_ms);
  }
  return parts;
}

/// The next part of the referee's log that is as long as one of the team's.
class NextRefereePart {
 public:
  explicit NextRefereePart(const RefereeLog* log) {
    if (log != nullptr) parts_ = referee_parts(*log);
  }
  std::optional<double> offset_ms(double greatest_ms) {
    for (; next_ < parts_.size(); ++next_) {
      const bool last = next_ + 1 == parts_.size();  // the team may go on after the box's last command
      if (last || greatest_ms < parts_[next_].longest_ms + kLongestStep_ms) return parts_[next_++].offset_ms;
    }
    return std::nullopt;
  }

 private:
  std::vector<RefereePart> parts_;
  std::size_t next_ = 0;
};

}  // namespace

std::vector<std::int64_t> record_times_ms(const TeamLog& log, const RefereeLog* referee) {
  std::vector<Part> parts;
  const std::vector<double> game_ms = game_times_ms(log, parts);
  NextRefereePart next_part(referee);
  std::vector<std::int64_t> times_ms;
  times_ms.reserve(game_ms.size());
  for (const Part& part : parts) {
    const auto by_referee_ms = next_part.offset_ms(game_ms[part.to - 1]);
    const auto by_stamps_ms = offset_by_stamps_ms(log, part, game_ms);
    const double last_ms = times_ms.empty() ? game_ms[part.from] : static_cast<double>(times_ms.back());
    const double offset_ms = by_stamps_ms    ? *by_stamps_ms
                             : by_referee_ms ? *by_referee_ms
                                             : last_ms - game_ms[part.from];
    for (std::size_t i = part.from; i < part.to; ++i) {
      const auto t_ms = static_cast<std::int64_t>(std::llround(offset_ms + game_ms[i]));
      times_ms.push_back(times_ms.empty() ? t_ms : std::max(t_ms, times_ms.back()));
    }
  }
  return times_ms;
}

}  // namespace trivela::evaluator::imports
