#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "evaluator/metrics/falling_instants.sql.hpp"
#include "evaluator/sessions/log_findings.hpp"
#include "kicking/geometry/time.hpp"

namespace trivela::evaluator {
namespace {

constexpr double kDrift = 2e-4;                      // two clocks part by less, of their time
constexpr std::int64_t kUtcStep_ns = 1'000'000'000;  // UTC of one machine from one session to the next

void find_falls(const log::Reader& reader, std::vector<std::string>& jumps) {
  reader.query(kFallingInstantsSql, [&](std::int64_t session_id, const std::string& stream, int robot_id,
                                        std::int64_t falls, std::int64_t largest_ns, std::int64_t at_t_ns) {
    jumps.push_back(fmt::format(
        "{} of robot {} in session {} falls back {} time{}, by up to {:.3f} s, to {:.3f} s first", stream, robot_id,
        session_id, falls, falls == 1 ? "" : "s", kicking::seconds(largest_ns), kicking::seconds(at_t_ns)));
  });
}

/// Measurements of one clock by another that no drift and no error explains.
void find_measured_steps(const log::Reader& reader, std::vector<std::string>& jumps) {
  struct Before {
    std::int64_t t_ns = 0, offset_ns = 0, error_ns = 0;
  };
  std::map<std::tuple<std::int64_t, int, int>, Before> last;
  reader.query(
      "SELECT session_id, robot_id, other_robot_id, t_ns, offset_ns, error_ns FROM clock_offsets ORDER BY session_id, "
      "robot_id, other_robot_id, t_ns",
      [&](std::int64_t session_id, int robot_id, int other, std::int64_t t_ns, std::int64_t offset_ns,
          std::int64_t error_ns) {
        const auto [place, first] = last.try_emplace({session_id, robot_id, other});
        const Before before = std::exchange(place->second, Before{t_ns, offset_ns, error_ns});
        if (first) return;
        const double step_ns = std::abs(static_cast<double>(offset_ns - before.offset_ns));
        const double allowed_ns =
            static_cast<double>(error_ns + before.error_ns) + kDrift * static_cast<double>(t_ns - before.t_ns);
        if (step_ns <= allowed_ns) return;
        jumps.push_back(fmt::format(
            "the clock of {} jumped by {:.3f} s against that of robot {}, between {:.1f} s and {:.1f} s of session {}",
            other == 0 ? "the base" : fmt::format("robot {}", other), 1e-9 * step_ns, robot_id,
            kicking::seconds(before.t_ns), kicking::seconds(t_ns), session_id));
      });
}

/// UTC that is another one in the session that goes on, by the same steady clock.
void find_utc_steps(const log::Reader& reader, std::vector<std::string>& jumps) {
  const auto sessions = reader.sessions();
  for (const log::RecordedSession& session : sessions) {
    const auto before = std::ranges::find(sessions, session.continues_uuid, &log::RecordedSession::uuid);
    if (session.continues_uuid.empty() || before == sessions.end()) continue;
    const bool same_start = session.started_t_ns >= before->started_t_ns;  // else the machine was started again
    const std::int64_t step_ns = session.realtime_offset_ns - before->realtime_offset_ns;
    if (session.simulated_clock || !same_start || std::abs(step_ns) < kUtcStep_ns) continue;
    jumps.push_back(fmt::format("UTC jumped by {:+.3f} s between session {} and session {}, which goes on from it",
                                kicking::seconds(step_ns), before->uuid, session.uuid));
  }
}

}  // namespace

std::vector<LogFinding> clock_findings(const log::Reader& reader) {
  std::vector<std::string> jumps;
  find_falls(reader, jumps);
  find_measured_steps(reader, jumps);
  find_utc_steps(reader, jumps);
  std::vector<LogFinding> findings;
  findings.reserve(jumps.size() + 1);
  for (const std::string& jump : jumps) {
    findings.push_back({"clock", Health::kDoubtful, jump,
                        "times across the jump cannot be compared; let a time service set the clock before the match "
                        "(trivela doctor --network), and measure offsets: trivela merge aligns by them"});
  }
  if (findings.empty()) findings.push_back({"clock", Health::kOk, "no clock jumped", ""});
  return findings;
}

}  // namespace trivela::evaluator
