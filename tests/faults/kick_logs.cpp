#include "tests/faults/kick_logs.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <exception>

#include "log/read/reader.hpp"

namespace trivela::faults {
namespace {

/// A status may be of a sample that is a little older than an order which the driver answered before it.
constexpr std::int64_t kBeside_ns = 100'000'000;

bool earlier(const AcceptedSoFar& a, const AcceptedSoFar& b) { return a.t_ns < b.t_ns; }

void read_log(const std::filesystem::path& path, KickRows& rows) {
  const log::Reader log{path};
  log.query("SELECT kick_id, accepted FROM kick_receipts ORDER BY t_ns, seq",
            [&](std::int64_t kick_id, bool accepted) { rows.accepted[kick_id] = accepted; });
  log.query("SELECT t_ns, orders_handled - orders_refused FROM kicker_status",
            [&](std::int64_t t_ns, std::int64_t accepted) {
              rows.counters.push_back({t_ns, accepted});
            });
}

bool counted(const FireSeen& fire, const std::vector<FireSeen>& fires, const std::vector<AcceptedSoFar>& counters) {
  const auto after =
      std::lower_bound(counters.begin(), counters.end(), AcceptedSoFar{fire.arrival_ns + kBeside_ns, 0}, earlier);
  if (after == counters.end()) return false;
  const auto next =
      std::upper_bound(counters.begin(), counters.end(), AcceptedSoFar{fire.arrival_ns - kBeside_ns, 0}, earlier);
  const AcceptedSoFar before = next == counters.begin() ? AcceptedSoFar{} : *(next - 1);
  const std::int64_t rise = after->accepted >= before.accepted ? after->accepted - before.accepted : after->accepted;
  const auto between = std::count_if(fires.begin(), fires.end(), [&](const FireSeen& other) {
    return other.arrival_ns > before.t_ns && other.arrival_ns <= after->t_ns;
  });
  return rise >= between;
}

}  // namespace

KickRows read_kick_rows(const std::vector<std::filesystem::path>& logs) {
  KickRows rows;
  for (const auto& path : logs) {
    try {
      read_log(path, rows);
    } catch (const std::exception& error) {
      rows.unreadable.push_back(fmt::format("{}: {}", path.filename().string(), error.what()));
    }
  }
  std::sort(rows.counters.begin(), rows.counters.end(), earlier);
  return rows;
}

LoggedKicks look_up(const std::vector<FireSeen>& fires, const KickRows& rows, bool steady_t_ns) {
  LoggedKicks out;
  for (const FireSeen& fire : fires) {
    const auto receipt = rows.accepted.find(fire.kick_id);
    if (receipt != rows.accepted.end() && receipt->second) {
      ++out.in_a_log;
    } else if (steady_t_ns && counted(fire, fires, rows.counters)) {
      ++out.counted;
    } else {
      out.lost.push_back(fire);
    }
  }
  return out;
}

}  // namespace trivela::faults
