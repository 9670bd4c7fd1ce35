#include "evaluator/learning/predicted_kicks.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include "evaluator/log/reader.hpp"
#include "evaluator/log/value.hpp"
#include "evaluator/metrics/compared_sessions.sql.hpp"
#include "evaluator/metrics/predicted_kicks.sql.hpp"

namespace trivela::evaluator {
namespace {

using LoggedCells = std::span<const log::Value>;

std::int64_t whole_number(const log::Value& value) { return std::get<std::int64_t>(value); }

std::optional<std::int64_t> whole_number_if_any(const log::Value& value) {
  const auto* const n = std::get_if<std::int64_t>(&value);
  return n != nullptr ? std::optional(*n) : std::nullopt;
}

/// A match: by what it was simulated from (scenario, seed), else by the stretch of time that its sessions share.
using LearnedMatch = std::tuple<bool, std::string, std::int64_t>;

/// A session, and in `match` its match, where that was simulated from a seed.
struct LearnedSession {
  std::int64_t started_utc_ns = 0;
  std::int64_t ended_utc_ns = 0;
  bool simulated = false;
  std::optional<LearnedMatch> match;
};

/// The sessions of all logs, by session_id.
using LearnedSessions = std::map<std::int64_t, LearnedSession>;

LearnedSession learned_session(LoggedCells row) {
  LearnedSession session;
  session.started_utc_ns = whole_number(row[1]);
  session.ended_utc_ns = whole_number_if_any(row[2]).value_or(session.started_utc_ns);
  session.simulated = whole_number(row[5]) != 0;
  const auto seed = whole_number_if_any(row[3]), match_id = whole_number_if_any(row[8]);
  if (!session.simulated || !(seed || match_id)) return session;
  const auto* const scenario = std::get_if<std::string>(&row[4]);
  session.match = LearnedMatch{true, scenario != nullptr ? *scenario : "", seed ? *seed : *match_id};
  return session;
}

/// Gives a match to every session that has none: robots that record the same minutes play the same match.
void match_by_time(LearnedSessions& sessions) {
  std::vector<LearnedSession*> rest;
  for (auto& [id, session] : sessions) {
    if (!session.match) rest.push_back(&session);
  }
  std::ranges::stable_sort(rest, {}, &LearnedSession::started_utc_ns);
  std::int64_t matches = 0, last_end_utc_ns = 0;
  std::optional<std::int64_t> real;
  for (LearnedSession* session : rest) {
    // Simulated clocks all start alike: their sessions only seem to overlap.
    if (session->simulated) {
      session->match = LearnedMatch{false, "", matches++};
      continue;
    }
    if (!real || session->started_utc_ns >= last_end_utc_ns) real = matches++;
    session->match = LearnedMatch{false, "", *real};
    last_end_utc_ns = std::max(last_end_utc_ns, session->ended_utc_ns);
  }
}

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
  PredictedKicks out;
  LearnedSessions sessions;
  std::vector<std::int64_t> session_ids;  // of the kicks
  for (const std::filesystem::path& path : logs) {
    const log::Reader reader{path};
    LearnedSessions fresh;
    std::int64_t again = 0;
    reader.query(kComparedSessionsSql, [&](LoggedCells row) {
      if (sessions.contains(whole_number(row[0])))
        ++again;
      else
        fresh.emplace(whole_number(row[0]), learned_session(row));
    });
    if (again > 0) {
      out.remarks.push_back(
          fmt::format("{}: {} of its sessions stand in an earlier log, too, and count once", path.string(), again));
    }
    reader.query(kPredictedKicksSql, [&](LoggedCells row) {
      if (source == PredictionSource::kInCharge && std::get<std::string>(row[0]) != "predictive") return;
      if (!fresh.contains(whole_number(row[1]))) return;
      session_ids.push_back(whole_number(row[1]));
      out.kicks.push_back(predicted_kick(row));
    });
    sessions.merge(fresh);
  }
  match_by_time(sessions);
  std::map<LearnedMatch, std::uint32_t> numbers;
  for (std::size_t i = 0; i < out.kicks.size(); ++i) {
    const LearnedMatch& match = *sessions.at(session_ids[i]).match;
    out.kicks[i].match = numbers.emplace(match, static_cast<std::uint32_t>(numbers.size())).first->second;
  }
  return out;
}

}  // namespace trivela::evaluator
