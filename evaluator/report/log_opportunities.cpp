#include "evaluator/report/log_opportunities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <unordered_map>

#include "evaluator/log/reader.hpp"
#include "evaluator/log/value.hpp"
#include "evaluator/metrics/compared_kicks.sql.hpp"
#include "evaluator/metrics/compared_sessions.sql.hpp"
#include "evaluator/metrics/first_decisions.sql.hpp"
#include "evaluator/metrics/minutes_by_half.sql.hpp"
#include "evaluator/metrics/opportunities.sql.hpp"

namespace trivela::evaluator {
namespace {

using Cells = std::span<const log::Value>;

std::int64_t integer(const log::Value& value) { return std::get<std::int64_t>(value); }

std::optional<std::int64_t> integer_if_any(const log::Value& value) {
  const auto* const n = std::get_if<std::int64_t>(&value);
  return n != nullptr ? std::optional(*n) : std::nullopt;
}

std::string text_if_any(const log::Value& value) {
  const auto* const text = std::get_if<std::string>(&value);
  return text != nullptr ? *text : std::string();
}

Ending ending_of(const std::string& outcome) {
  if (outcome.empty() || outcome == "unknown") return Ending::kUnknown;
  return outcome == "on_target" ? Ending::kInside : Ending::kOutside;
}

using SessionPlaces = std::unordered_map<std::int64_t, std::uint32_t>;

// What is known of the logs before.
struct Known {
  SessionPlaces sessions;
  // Matches of experiments: seed, arm, configuration, table. Other flags of the run do not make other kicks.
  std::set<std::tuple<std::int64_t, std::string, std::string, std::string>> played;
  SetupBook setups;
};

std::map<std::string, SessionSetup> setups_of(const log::Reader& reader, SetupBook& book) {
  std::map<std::string, SessionSetup> setups;
  reader.query("SELECT DISTINCT config_sha256, text FROM sessions JOIN texts ON sha256 = config_sha256",
               [&](Cells row) { setups[text_if_any(row[0])] = book.of(text_if_any(row[1])); });
  return setups;
}

ComparedSession session_of(Cells row, const std::map<std::string, SessionSetup>& setups) {
  ComparedSession session;
  session.session_id = integer(row[0]);
  session.started_utc_ns = integer(row[1]);
  session.closed_utc_ns = integer_if_any(row[2]);
  session.seed = integer_if_any(row[3]);
  session.scenario = text_if_any(row[4]);
  session.simulated = integer(row[5]) != 0;
  session.arm = text_if_any(row[6]);
  session.table = text_if_any(row[7]);
  session.match_id = integer_if_any(row[8]);
  session.config_sha256 = text_if_any(row[9]);
  if (const auto setup = setups.find(session.config_sha256); setup != setups.end()) session.setup = setup->second;
  return session;
}

// Sessions of a log that no earlier log has, by id.
SessionPlaces add_sessions(const log::Reader& reader, const std::string& name, LoggedOpportunities& logged,
                           Known& known) {
  SessionPlaces fresh;
  std::int64_t again = 0, open = 0, replayed = 0;
  const auto setups = setups_of(reader, known.setups);
  reader.query(kComparedSessionsSql, [&](Cells row) {
    ComparedSession session = session_of(row, setups);
    if (known.sessions.contains(session.session_id)) {
      ++again;
      return;
    }
    const bool numbered = session.match_id && session.seed;
    if (numbered && !known.played.insert({*session.seed, session.arm, session.config_sha256, session.table}).second) {
      ++replayed;
      return;
    }
    open += session.closed_utc_ns ? 0 : 1;
    const auto place = static_cast<std::uint32_t>(logged.sessions.size());
    fresh[session.session_id] = known.sessions[session.session_id] = place;
    logged.sessions.push_back(std::move(session));
  });
  const auto remark = [&](std::int64_t n, const char* what) {
    if (n > 0) logged.remarks.push_back(fmt::format("{}: {} {}", name, n, what));
  };
  remark(again, "of its sessions stand in an earlier log, too, and count once");
  remark(replayed, "of its matches were played before with the same seed, arm and configuration, and count once");
  remark(open, "sessions were not closed, their last kicks may be missing");
  reader.query("SELECT matches_done, matches FROM experiments WHERE matches_done < matches", [&](Cells row) {
    logged.remarks.push_back(fmt::format("{}: the experiment is not finished, {} of {} matches are there", name,
                                         integer(row[0]), integer(row[1])));
  });
  return fresh;
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
  });
  if (alone > 0 && !places.empty()) {
    logged.remarks.push_back(fmt::format("{} kicks belong to no possession that the log knows", alone));
  }
}

void number_matches(LoggedOpportunities& logged) {
  using Numbered = std::pair<std::string, std::int64_t>;  // scenario, and seed or match
  std::map<std::pair<Numbered, std::uint32_t>, std::uint32_t> simulated;
  std::map<Numbered, std::uint32_t> first_world;
  std::set<std::string> of_several_worlds;
  std::int64_t last_end_utc_ns = 0;
  std::optional<std::uint32_t> last_real;
  std::vector<std::size_t> order(logged.sessions.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return logged.sessions[i].started_utc_ns; });
  for (const std::size_t i : order) {
    ComparedSession& session = logged.sessions[i];
    if (session.simulated && (session.match_id || session.seed)) {
      const Numbered key{session.scenario, session.seed ? *session.seed : *session.match_id};
      const auto [place, added] = simulated.try_emplace({key, session.setup.world}, logged.matches);
      logged.matches += added ? 1 : 0;
      session.match = place->second;
      if (first_world.try_emplace(key, session.setup.world).first->second != session.setup.world)
        of_several_worlds.insert(session.scenario);
      continue;
    }
    if (session.simulated || !last_real || session.started_utc_ns >= last_end_utc_ns) {
      last_real = logged.matches++;
      last_end_utc_ns = session.started_utc_ns;
    }
    session.match = *last_real;
    last_end_utc_ns = std::max(last_end_utc_ns, session.closed_utc_ns.value_or(session.started_utc_ns));
  }
  for (const std::string& scenario : of_several_worlds)
    logged.remarks.push_back(fmt::format(
        "scenario '{}' is not the same in all sessions: matches of the same seed are not the same opportunities",
        scenario));
}

}  // namespace

LoggedOpportunities read_opportunities(const std::vector<std::filesystem::path>& logs, bool truth) {
  LoggedOpportunities logged;
  Known known;
  for (const std::filesystem::path& path : logs) {
    const log::Reader reader(path);
    const SessionPlaces fresh = add_sessions(reader, path.string(), logged, known);
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
  number_matches(logged);
  return logged;
}

}  // namespace trivela::evaluator
