#include "evaluator/learning/predicted_kicks.hpp"

#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "evaluator/log/reader.hpp"
#include "evaluator/log/value.hpp"
#include "evaluator/metrics/predicted_kicks.sql.hpp"

namespace trivela::evaluator {
namespace {

/// File, whether the match has a number, and that or its session.
using MatchKey = std::tuple<std::size_t, bool, std::int64_t>;

}  // namespace

std::vector<PredictedKick> predicted_kicks(const std::vector<std::filesystem::path>& logs, PredictionSource source) {
  std::vector<PredictedKick> kicks;
  std::map<MatchKey, std::uint32_t> matches;
  for (std::size_t file = 0; file < logs.size(); ++file) {
    const log::Reader reader{logs[file]};
    reader.query(kPredictedKicksSql, [&](std::span<const log::Value> row) {
      if (source == PredictionSource::kInCharge && std::get<std::string>(row[0]) != "predictive") return;
      const auto* match_id = std::get_if<std::int64_t>(&row[1]);
      const MatchKey key{file, match_id != nullptr, match_id ? *match_id : std::get<std::int64_t>(row[2])};
      const auto match = matches.emplace(key, static_cast<std::uint32_t>(matches.size())).first->second;
      kicks.push_back({.match = match,
                       .shot = {.p_on_target = log::number(row[4]),
                                .distance_m = log::number(row[5]),
                                .vx_mps = log::number(row[6]),
                                .vy_mps = log::number(row[7]),
                                .omega_radps = log::number(row[8]),
                                .power = log::number(row[9]),
                                .opponent_distance_m = log::number_if_any(row[10])},
                       .on_target = log::number(row[11]) > 0.5});
    });
  }
  return kicks;
}

}  // namespace trivela::evaluator
