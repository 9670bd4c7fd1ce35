#include "tests/faults/kicker_timeline.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>

#include "hal/board/kicker_board.hpp"
#include "log/read/reader.hpp"
#include "tests/faults/kick_logs.hpp"

namespace trivela::faults {
namespace {

constexpr std::int64_t kMs_ns = 1'000'000;
constexpr std::int64_t kOldest_ns = 100 * kMs_ns;      // max_order_age_s, and the board's own patience after an instant
constexpr std::int64_t kOldestHeld_ns = 500 * kMs_ns;  // of what lay in a line that held it back for so long
constexpr std::int64_t kLine_ns = 30 * kMs_ns;         // to the emulator's thread on a busy machine
constexpr std::int64_t kQuestions_ns = 20 * kMs_ns;    // from one to the next

/// Nobody can call back what is on its way when a line begins to hold back, which shows when an answer is missing.
bool lay_in_the_line(const KickerTimeline& timeline, std::int64_t ordered_t_ns) {
  constexpr std::int64_t kUnnoticed_ns = kQuestions_ns + hal::KickerBoard::kDoubt_ns + kLine_ns;
  return std::ranges::any_of(timeline.troubles, [&](const auto& trouble) {
    const std::int64_t after_ns = ordered_t_ns - trouble.first;
    return trouble.second == Trouble::kHold && after_ns > -kLine_ns && after_ns < kUnnoticed_ns;
  });
}

/// The lawful order of a pulse: fresh, and nobody's before.
std::optional<std::int64_t> order_of(const KickerTimeline& timeline, const BoardPulse& pulse,
                                     std::set<std::int64_t>& fired) {
  for (const auto& [kick_id, ordered] : timeline.ordered) {
    const std::int64_t age_ns = pulse.t_ns - ordered.t_ns;
    const std::int64_t oldest_ns = lay_in_the_line(timeline, ordered.t_ns) ? kOldestHeld_ns : kOldest_ns;
    const bool fits = ordered.kind == OrderKind::kLawful && ordered.units == pulse.units && age_ns >= 0 &&
                      age_ns <= oldest_ns + kLine_ns;
    if (fits && fired.insert(kick_id).second) return kick_id;
  }
  return std::nullopt;
}

bool while_it_stands(const KickerTimeline& timeline, std::int64_t t_ns) {
  const auto word = timeline.playing.upper_bound(t_ns - kLine_ns);
  const bool stands = word != timeline.playing.begin() && !std::prev(word)->second;
  const bool starts_now = word != timeline.playing.end() && word->first <= t_ns;
  return stands && !starts_now;
}

/// What was going on, and the last order of its power before it.
std::string circumstances(const KickerTimeline& timeline, const BoardPulse& pulse) {
  const auto trouble = timeline.troubles.upper_bound(pulse.t_ns);
  std::string said =
      trouble == timeline.troubles.begin()
          ? "before any trouble"
          : fmt::format("{} ms after the start of \"{}\"", (pulse.t_ns - std::prev(trouble)->first) / kMs_ns,
                        name(std::prev(trouble)->second));
  for (auto last = timeline.ordered.rbegin(); last != timeline.ordered.rend(); ++last) {
    if (last->second.units != pulse.units || last->second.t_ns > pulse.t_ns) continue;
    return said + fmt::format(", {} ms after order {} of kind {}", (pulse.t_ns - last->second.t_ns) / kMs_ns,
                              last->first, static_cast<int>(last->second.kind));
  }
  return said;
}

/// From the last status of a driver before it fell silent to the next.
struct Silence {
  std::int64_t from_t_ns = 0, to_t_ns = 0;
};

std::vector<Silence> silences_in(const std::filesystem::path& path) {
  std::vector<Silence> found;
  log::Reader{path}.query(
      "SELECT from_t_ns, to_t_ns FROM losses WHERE stream = 'kicker_status' AND robot_id <> 0 AND to_t_ns IS NOT NULL",
      [&](std::int64_t from_t_ns, std::int64_t to_t_ns) {
        found.push_back({from_t_ns, to_t_ns});
      });
  return found;
}

}  // namespace

JudgedPulses judge_pulses(const KickerTimeline& timeline) {
  JudgedPulses out;
  std::set<std::int64_t> fired;
  for (const BoardPulse& pulse : timeline.pulses) {
    const auto order = order_of(timeline, pulse, fired);
    if (order) out.kicks.push_back({pulse.t_ns, pulse.t_ns, *order, false});
    if (!order)
      out.complaints.push_back(fmt::format("a pulse of {} units without a lawful fresh order of its own: {}",
                                           pulse.units, circumstances(timeline, pulse)));
    if (while_it_stands(timeline, pulse.t_ns))
      out.complaints.push_back(fmt::format("a pulse while the game stands: {}", circumstances(timeline, pulse)));
  }
  return out;
}

std::vector<std::string> unlogged(const std::vector<FireSeen>& kicks, const std::filesystem::path& log) {
  const KickRows rows = read_kick_rows({log});
  std::vector<std::string> out = rows.unreadable;
  if (!out.empty()) return out;
  const std::vector<Silence> silences = silences_in(log);
  for (const FireSeen& kick : look_up(kicks, rows, true).lost) {
    const bool silent = std::ranges::any_of(silences, [&](const Silence& silence) {
      return silence.from_t_ns <= kick.arrival_ns && kick.arrival_ns <= silence.to_t_ns;
    });
    const auto receipt = rows.accepted.find(kick.kick_id);
    const bool refused = receipt != rows.accepted.end() && !receipt->second;
    if (!silent || refused)
      out.push_back(fmt::format("kick {} was {}", kick.kick_id,
                                refused ? "refused, says the log" : "neither logged nor in a counted gap"));
  }
  return out;
}

}  // namespace trivela::faults
