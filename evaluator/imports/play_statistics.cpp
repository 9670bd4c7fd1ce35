#include "evaluator/imports/play_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>

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

namespace {

double seconds_between(std::int64_t from_ms, std::int64_t to_ms) { return 1e-3 * static_cast<double>(to_ms - from_ms); }

/// What began and has not ended yet, command by command.
class PlayCount {
 public:
  explicit PlayCount(int part) : part_(part) {}

  void receive(const RefereeLine& line) {
    if (line.command == BoxCommand::kStart) return start(line.t_ms);
    if (line.command == BoxCommand::kStop) return stop(line.t_ms);
    if (is_restart(line.command)) restart_ms_ = line.t_ms;
    const auto begun = begun_part(line.command);
    if (begun || ends_part(line.command)) {
      end_play(line.t_ms, false);
      stop_ms_.reset();
    }
    if (begun) part_ = *begun;
  }

  PlayStatistics finish() && {
    statistics_.open_plays = start_ms_ ? 1 : 0;
    return std::move(statistics_);
  }

 private:
  void start(std::int64_t t_ms) {
    if (stop_ms_) statistics_.stop_to_start_s.push_back(seconds_between(*stop_ms_, t_ms));
    if (restart_ms_) statistics_.restart_to_start_s.push_back(seconds_between(*restart_ms_, t_ms));
    stop_ms_.reset();
    restart_ms_.reset();
    if (!start_ms_) start_ms_ = t_ms;
  }

  void stop(std::int64_t t_ms) {
    const bool played = start_ms_.has_value();
    end_play(t_ms, true);
    if (played) stop_ms_ = t_ms;
    restart_ms_.reset();
  }

  void end_play(std::int64_t t_ms, bool stopped) {
    if (start_ms_) statistics_.plays.push_back({*start_ms_, t_ms, part_, stopped});
    start_ms_.reset();
  }

  PlayStatistics statistics_{};
  int part_;
  std::optional<std::int64_t> start_ms_, stop_ms_, restart_ms_;
};

}  // namespace

double PlayStatistics::played_s() const {
  return std::accumulate(plays.begin(), plays.end(), 0.0,
                         [](double sum, const Play& play) { return sum + seconds_between(play.from_ms, play.to_ms); });
}

std::int64_t PlayStatistics::stops() const { return std::ranges::count_if(plays, &Play::stopped); }

std::optional<double> PlayStatistics::stops_per_min() const {
  const double played = played_s();
  return played > 0.0 ? std::optional(60.0 * static_cast<double>(stops()) / played) : std::nullopt;
}

PlayStatistics play_statistics(const RefereeLog& log) {
  PlayCount count(first_part(log));
  for (const RefereeLine& line : log.lines) count.receive(line);
  return std::move(count).finish();
}

int first_part(const RefereeLog& log) {
  if (log.lines.empty()) return 1;
  const std::string& state = log.lines.front().state;
  const bool second = state.find("2nd") != std::string::npos, over = state.find("vertime") != std::string::npos;
  return (second ? 2 : 1) + (over ? 2 : 0);
}

std::optional<double> median(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

std::optional<double> quantile(std::vector<double> values, double fraction) {
  if (values.empty()) return std::nullopt;
  std::ranges::sort(values);
  const auto rank = static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(values.size())));
  return values[std::clamp<std::size_t>(rank, 1, values.size()) - 1];
}

std::optional<double> mean(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::vector<Possession> possessions(const TeamLog& log, const std::vector<std::int64_t>& times_ms) {
  std::vector<Possession> found;
  std::map<int, Possession> open;  // by robot
  const auto close = [&](Possession&& possession) {
    if (possession.to_ms - possession.from_ms >= kShortestPossession_ms) found.push_back(std::move(possession));
  };
  for (std::size_t i = 0; i < log.usable.size(); ++i) {
    for (const ReportedRobot& robot : log.usable[i].robots) {
      if (!robot.ball_engaged) continue;
      const auto place = open.try_emplace(robot.id, Possession{robot.id, times_ms[i], times_ms[i]}).first;
      if (times_ms[i] - place->second.to_ms >= kSamePossession_ms)
        close(std::exchange(place->second, Possession{robot.id, times_ms[i], times_ms[i]}));
      place->second.to_ms = times_ms[i];
      if (robot.velocity) place->second.speeds_mps.push_back(std::hypot((*robot.velocity)[0], (*robot.velocity)[1]));
    }
  }
  for (auto& [robot_id, possession] : open) close(std::move(possession));
  std::ranges::stable_sort(found, {}, &Possession::to_ms);
  return found;
}

}  // namespace trivela::evaluator::imports
