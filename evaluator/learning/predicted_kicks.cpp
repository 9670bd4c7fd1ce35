#include "evaluator/learning/predicted_kicks.hpp"

#include <map>

#include "evaluator/metrics/predicted_kicks.sql.hpp"
#include "evaluator/sessions/log_sessions.hpp"
#include "log/read/reader.hpp"

namespace trivela::evaluator {
PredictedKicks predicted_kicks(const std::vector<std::filesystem::path>& logs, PredictionSource source,
                               const std::function<void(std::size_t, std::size_t)>& told) {
  struct Recorded {
    std::uint32_t session;
    int robot_id;
    std::int64_t kick_id;
    PredictedKick kick;
  };
  std::vector<Recorded> recorded;
  SessionIndex book;
  for (const std::filesystem::path& path : logs) {
    told(static_cast<std::size_t>(&path - logs.data()), logs.size());
    const log::Reader reader{path};
    const SessionPlaces fresh = book.add(reader, path.string());
    reader.query(kPredictedKicksSql,
                 [&](const std::string& policy, std::int64_t session_id, int robot_id, double p_on_target,
                     double distance_m, double vx_mps, double vy_mps, double omega_radps, double power,
                     std::optional<double> opponent_distance_m, bool on_target, std::int64_t kick_id) {
                   if (source == PredictionSource::kInCharge && policy != "predictive") return;
                   const auto session = fresh.find(session_id);
                   if (session == fresh.end()) return;
                   recorded.push_back({session->second, robot_id, kick_id,
                                       PredictedKick{.match = 0,
                                                     .shot = {.p_on_target = p_on_target,
                                                              .distance_m = distance_m,
                                                              .vx_mps = vx_mps,
                                                              .vy_mps = vy_mps,
                                                              .omega_radps = omega_radps,
                                                              .power = power,
                                                              .opponent_distance_m = opponent_distance_m},
                                                     .on_target = on_target}});
                 });
  }
  book.refuse_replays_alone();
  book.settle();
  PredictedKicks out{.kicks = {}, .remarks = book.remarks()};
  out.remarks.insert(out.remarks.end(), book.not_counted().begin(), book.not_counted().end());
  std::map<std::uint32_t, std::uint32_t> numbers;  // of the matches with a kick
  for (Recorded& r : recorded) {
    if (!book.counts(r.session, r.robot_id, r.kick_id)) continue;
    const std::uint32_t match = book.sessions()[r.session].match;
    r.kick.match = numbers.try_emplace(match, static_cast<std::uint32_t>(numbers.size())).first->second;
    out.kicks.push_back(r.kick);
  }
  return out;
}

}  // namespace trivela::evaluator
