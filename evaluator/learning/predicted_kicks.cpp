#include "evaluator/learning/predicted_kicks.hpp"

#include <map>

#include "evaluator/log/reader.hpp"
#include "evaluator/log/value.hpp"
#include "evaluator/metrics/predicted_kicks.sql.hpp"
#include "evaluator/report/log_sessions.hpp"

namespace trivela::evaluator {
namespace {

using LoggedCells = std::span<const log::Value>;

PredictedKick predicted_kick(LoggedCells row) {
  return {.match = 0,
          .shot = {.p_on_target = log::number(row[3]),
                   .distance_m = log::number(row[4]),
                   .vx_mps = log::number(row[5]),
                   .vy_mps = log::number(row[6]),
                   .omega_radps = log::number(row[7]),
                   .power = log::number(row[8]),
                   .opponent_distance_m = log::number_if_any(row[9])},
          .on_target = log::number(row[10]) > 0.5};
}

}  // namespace

PredictedKicks predicted_kicks(const std::vector<std::filesystem::path>& logs, PredictionSource source) {
  struct Recorded {
    std::uint32_t session;
    int robot_id;
    std::int64_t kick_id;
    PredictedKick kick;
  };
  std::vector<Recorded> recorded;
  SessionBook book;
  for (const std::filesystem::path& path : logs) {
    const log::Reader reader{path};
    const SessionPlaces fresh = book.add(reader, path.string());
    reader.query(kPredictedKicksSql, [&](LoggedCells row) {
      if (source == PredictionSource::kInCharge && log::text_if_any(row[0]) != "predictive") return;
      const auto session = fresh.find(log::integer(row[1]));
      if (session == fresh.end()) return;
      recorded.push_back(
          {session->second, static_cast<int>(log::integer(row[2])), log::integer(row[11]), predicted_kick(row)});
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
