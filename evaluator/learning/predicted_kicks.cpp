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
  SessionIndex sessions_read;
  for (const std::filesystem::path& path : logs) {
    told(static_cast<std::size_t>(&path - logs.data()), logs.size());
    const log::Reader reader{path};
    const SessionPlaces fresh = sessions_read.add(reader, path.string());
    reader.query(kPredictedKicksSql, [&](const log::NamedCells& row) {
      if (source == PredictionSource::kInCharge && row.get<std::string>("policy") != "predictive") return;
      const auto session = fresh.find(row.get<std::int64_t>("session_id"));
      if (session == fresh.end()) return;
      recorded.push_back({session->second, row.get<int>("robot_id"), row.get<std::int64_t>("kick_id"),
                          PredictedKick{.match = 0,
                                        .shot = {.p_on_target = row.get<double>("p_on_target"),
                                                 .distance_m = row.get<double>("distance_m"),
                                                 .vx_mps = row.get<double>("vx_mps"),
                                                 .vy_mps = row.get<double>("vy_mps"),
                                                 .omega_radps = row.get<double>("omega_radps"),
                                                 .power = row.get<double>("power"),
                                                 .opponent_distance_m = row.find<double>("opponent_distance_m")},
                                        .on_target = row.get<bool>("on_target")}});
    });
  }
  sessions_read.refuse_replays_alone();
  sessions_read.settle();
  PredictedKicks out{.kicks = {}, .remarks = sessions_read.remarks()};
  out.remarks.insert(out.remarks.end(), sessions_read.not_counted().begin(), sessions_read.not_counted().end());
  std::map<std::uint32_t, std::uint32_t> numbers;  // of the matches with a kick
  for (Recorded& r : recorded) {
    if (!sessions_read.counts(r.session, r.robot_id, r.kick_id)) continue;
    const std::uint32_t match = sessions_read.sessions()[r.session].match;
    r.kick.match = numbers.try_emplace(match, static_cast<std::uint32_t>(numbers.size())).first->second;
    out.kicks.push_back(r.kick);
  }
  return out;
}

}  // namespace trivela::evaluator
