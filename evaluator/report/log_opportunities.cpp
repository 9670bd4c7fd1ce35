#include "evaluator/report/log_opportunities.hpp"

#include <fmt/format.h>

#include <cmath>
#include <tuple>
#include <unordered_map>

#include "evaluator/log/reader.hpp"
#include "evaluator/log/value.hpp"
#include "evaluator/metrics/compared_kicks.sql.hpp"
#include "evaluator/metrics/first_decisions.sql.hpp"
#include "evaluator/metrics/minutes_by_half.sql.hpp"
#include "evaluator/metrics/opportunities.sql.hpp"
#include "evaluator/report/log_sessions.hpp"

namespace trivela::evaluator {
namespace {

using Cells = std::span<const log::Value>;
using log::integer, log::text_if_any;

Ending ending_of(const std::string& outcome) {
  if (outcome.empty() || outcome == "unknown") return Ending::kUnknown;
  return outcome == "on_target" ? Ending::kInside : Ending::kOutside;
}

std::optional<bool> said(const log::Value& value) {
  const auto* const number = std::get_if<std::int64_t>(&value);
  return number != nullptr ? std::optional(*number != 0) : std::nullopt;
}

// Place of a possession in the rows.
using Key = std::tuple<std::uint32_t, int, int, std::int64_t>;  // session, robot, half, possession

struct KeyHash {
  std::size_t operator()(const Key& key) const {
    const auto [session, robot, half, possession] = key;
    std::uint64_t h = (static_cast<std::uint64_t>(session) << 32) ^ static_cast<std::uint64_t>(possession);
    h ^= static_cast<std::uint64_t>(robot * 2 + half) << 56;
    h *= 0x9E3779B97F4A7C15ULL;
    return static_cast<std::size_t>(h ^ (h >> 29));
  }
};

void add_opportunities(const log::Reader& reader, const SessionPlaces& sessions, bool truth,
                       LoggedOpportunities& logged) {
  // The goal's middle is the same all over a log; a log without a kick needs no distance.
  std::optional<double> goal_y_m;
  reader.query("SELECT max(target_y_m) FROM (SELECT target_y_m FROM kick_decisions LIMIT 1000)",
               [&](Cells row) { goal_y_m = log::number_if_any(row[0]); });
  std::unordered_map<Key, std::size_t, KeyHash> places;
  reader.query(kOpportunitiesSql, [&](Cells row) {
    const auto session = sessions.find(integer(row[0]));
    if (session == sessions.end()) return;
    LoggedOpportunity o;
    o.session = session->second;
    o.robot_id = static_cast<int>(integer(row[1]));
    o.half = static_cast<int>(integer(row[2]));
    o.possession_id = integer(row[3]);
    o.policy = text_if_any(row[4]);
    o.probability = log::number_if_any(row[5]);
    const auto x_m = log::number_if_any(row[6]), y_m = log::number_if_any(row[7]);
    o.start_x_m = x_m;
    if (x_m && y_m && goal_y_m) o.start_distance_m = std::hypot(*x_m, *goal_y_m - *y_m);
    places[{o.session, o.robot_id, o.half, o.possession_id}] = logged.rows.size();
    logged.rows.push_back(std::move(o));
  });
  reader.query(kFirstDecisionsSql, [&](Cells row) {
    const auto session = sessions.find(integer(row[0]));
    if (session == sessions.end()) return;
    const auto place = places.find(
        {session->second, static_cast<int>(integer(row[1])), static_cast<int>(integer(row[2])), integer(row[3])});
    if (place == places.end()) return;
    logged.rows[place->second].first = {log::number_if_any(row[5]).value_or(0.0),
                                        log::number_if_any(row[6]).value_or(0.0), log::number_if_any(row[7])};
  });
  std::int64_t alone = 0;
  reader.query(kComparedKicksSql, [&](Cells row) {
    const auto session = sessions.find(integer(row[0]));
    if (session == sessions.end()) return;
    const Key key{session->second, static_cast<int>(integer(row[1])), static_cast<int>(integer(row[2])),
                  integer(row[3])};
    const auto place = places.find(key);
    if (place == places.end()) {
      LoggedOpportunity o;
      std::tie(o.session, o.robot_id, o.half, o.possession_id) = key;
      o.has_possession = false;
      logged.rows.push_back(std::move(o));
      ++alone;
    }
    LoggedOpportunity& o = place == places.end() ? logged.rows.back() : logged.rows[place->second];
    o.policy = text_if_any(row[4]);  // of two kicks of a possession the later one
    const std::string outcome = text_if_any(row[truth ? 6 : 5]);
    // The simulator settles every ball that left; without its word there was none in front of the kicker.
    const bool no_ball = truth && outcome.empty() && logged.sessions[o.session].simulated;
    o.ending = no_ball ? Ending::kNoKick : ending_of(outcome);
    o.distance_m = log::number_if_any(row[7]);
    const auto p_inside = truth ? std::nullopt : log::number_if_any(row[8]);
    o.doubt = !p_inside                      ? 0.0
              : o.ending == Ending::kInside  ? 1.0 - *p_inside
              : o.ending == Ending::kOutside ? *p_inside
                                             : 0.0;
    o.blocked = outcome == "blocked";
    o.bounced = said(row[9]);
    o.truth_bounced = said(row[10]);
    o.saved = said(row[11]).value_or(false);
    o.goal = text_if_any(row[6]) == "on_target" && !o.saved;
  });
  if (alone > 0 && !places.empty()) {
    logged.remarks.push_back(fmt::format("{} kicks belong to no possession that the log knows", alone));
  }
}

}  // namespace

LoggedOpportunities read_opportunities(const std::vector<std::filesystem::path>& logs, bool truth) {
  LoggedOpportunities logged;
  SessionBook book(logged);
  for (const std::filesystem::path& path : logs) {
    const log::Reader reader(path);
    const SessionPlaces fresh = book.add(reader, path.string());
    add_opportunities(reader, fresh, truth, logged);
    reader.query(kMinutesByHalfSql, [&](Cells row) {
      const auto session = fresh.find(integer(row[0]));
      if (session == fresh.end()) return;
      logged.halves.push_back({session->second, static_cast<int>(integer(row[1])), text_if_any(row[2]),
                               log::number_if_any(row[3]).value_or(0.0)});
    });
    std::int64_t missing = 0;
    for (const log::Loss& loss : reader.losses()) missing += loss.missing();
    if (missing > 0)
      logged.remarks.push_back(
          fmt::format("{}: {} rows are missing (trivela report says which)", path.string(), missing));
  }
  book.number_matches();
  return logged;
}

}  // namespace trivela::evaluator
