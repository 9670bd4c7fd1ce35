#include "tests/faults/kick_logs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>

#include "evaluator/log/reader.hpp"

namespace trivela::faults {
namespace {

using evaluator::log::Reader;

/// A status may be of a sample that is a little older than the order which the driver answered before it.
constexpr std::int64_t kBeside_ns = 100'000'000;

/// The driver's counters at an instant.
struct Counted {
  std::int64_t t_ns = 0;
  std::int64_t accepted = 0;
};

using Counters = std::vector<Counted>;  // by t_ns

void read_log(const std::filesystem::path& path, std::map<std::int64_t, bool>& accepted, Counters& counters) {
  const Reader log{path};
  log.query("SELECT kick_id, accepted FROM kick_receipts ORDER BY t_ns",
            [&](const auto& row) { accepted[std::get<std::int64_t>(row[0])] = std::get<std::int64_t>(row[1]) != 0; });
  log.query("SELECT t_ns, orders_handled - orders_refused FROM kicker_status", [&](const auto& row) {
    counters.push_back({std::get<std::int64_t>(row[0]), std::get<std::int64_t>(row[1])});
  });
}

/// Kicks that the counters tell of between the rows around [from, to]; a driver that was started in between counts from
/// 0.
std::int64_t counted_around(const Counters& counters, std::int64_t from_ns, std::int64_t to_ns) {
  const auto earlier = [](const Counted& a, const Counted& b) { return a.t_ns < b.t_ns; };
  const auto after = std::lower_bound(counters.begin(), counters.end(), Counted{to_ns, 0}, earlier);
  auto before = std::upper_bound(counters.begin(), counters.end(), Counted{from_ns, 0}, earlier);
  if (after == counters.end()) return 0;
  const std::int64_t was = before == counters.begin() ? 0 : (before - 1)->accepted;
  return after->accepted >= was ? after->accepted - was : after->accepted;
}

bool counted(const FireSeen& fire, const std::vector<FireSeen>& fires, const Counters& counters) {
  const auto rise = counted_around(counters, fire.arrival_ns - kBeside_ns, fire.arrival_ns + kBeside_ns);
  if (rise == 0) return false;
  // All that were fired between the two rows share the rise.
  const auto earlier = [](const Counted& a, const Counted& b) { return a.t_ns < b.t_ns; };
  const auto after =
      std::lower_bound(counters.begin(), counters.end(), Counted{fire.arrival_ns + kBeside_ns, 0}, earlier);
  const auto before =
      std::upper_bound(counters.begin(), counters.end(), Counted{fire.arrival_ns - kBeside_ns, 0}, earlier);
  const std::int64_t from_ns = before == counters.begin() ? 0 : (before - 1)->t_ns;
  const auto between = std::count_if(fires.begin(), fires.end(), [&](const FireSeen& other) {
    return other.arrival_ns > from_ns && other.arrival_ns <= after->t_ns;
  });
  return rise >= between;
}

}  // namespace

LoggedKicks look_up(const std::vector<FireSeen>& fires, const std::vector<std::filesystem::path>& logs,
                    bool steady_t_ns) {
  LoggedKicks out;
  std::map<std::int64_t, bool> accepted;
  Counters counters;
  for (const auto& path : logs) {
    try {
      read_log(path, accepted, counters);
    } catch (const std::exception& error) {
      out.unreadable.push_back(fmt::format("{}: {}", path.filename().string(), error.what()));
    }
  }
  std::sort(counters.begin(), counters.end(), [](const Counted& a, const Counted& b) { return a.t_ns < b.t_ns; });
  for (const FireSeen& fire : fires) {
    const auto receipt = accepted.find(fire.kick_id);
    if (receipt != accepted.end() && receipt->second) {
      ++out.in_a_log;
    } else if (steady_t_ns && counted(fire, fires, counters)) {
      ++out.counted;
    } else {
      out.lost.push_back(fire);
    }
  }
  return out;
}

}  // namespace trivela::faults
