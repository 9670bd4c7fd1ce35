#include "evaluator/counting/log_opportunities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "evaluator/counting/log_minutes.hpp"
#include "evaluator/metrics/assigned_possessions.sql.hpp"
#include "evaluator/metrics/compared_kicks.sql.hpp"
#include "evaluator/metrics/first_decisions.sql.hpp"
#include "evaluator/metrics/opportunities.sql.hpp"
#include "evaluator/sessions/label_quality.hpp"
#include "evaluator/sessions/log_sessions.hpp"
#include "evaluator/sessions/recording_gaps.hpp"

namespace trivela::evaluator {
namespace {

Ending ending_of(const std::string& outcome) {
  if (outcome.empty() || outcome == "unknown") return Ending::kUnknown;
  return outcome == "on_target" ? Ending::kInside : Ending::kOutside;
}

// What the logs say, of every session; what counts is known when all are read.
struct SeenRows {
  std::vector<LoggedOpportunity> opportunities;
  std::vector<CountedKick> kicks;
  RecordedPlay play;
};

// The possession of a row by its robot's own count, in the simulator's count where that has one; none: a session that
// is left out.
std::optional<PossessionKey> possession_of(const log::NamedCells& row, const SessionPlaces& sessions,
                                           const TruthCount& truths) {
  const auto session_id = row.get<std::int64_t>("session_id");
  const auto session = sessions.find(session_id);
  if (session == sessions.end()) return std::nullopt;
  const auto robot_id = row.get<int>("robot_id"), half = row.get<int>("half");
  const auto own = row.get<std::int64_t>("possession_id");
  return PossessionKey{session->second, robot_id, half, truths.number(session_id, robot_id, half, own)};
}

// Who was in charge of the simulator's possessions, and possessions that the robots alone counted.
void see_assigned(const log::Reader& reader, const SessionPlaces& sessions, const TruthCount& truths,
                  PossessionPlaces& places, std::vector<LoggedOpportunity>& opportunities) {
  reader.query(kAssignedPossessionsSql, [&](const log::NamedCells& row) {
    const auto key = possession_of(row, sessions, truths);
    if (!key) return;
    const bool alone = std::get<3>(*key) != 0 && !truths.has(row.get<std::int64_t>("session_id"));
    if (alone && places.try_emplace(*key, opportunities.size()).second) {
      LoggedOpportunity& o = opportunities.emplace_back();
      std::tie(o.session, o.robot_id, o.half, o.possession_id) = *key;
    }
    const auto place = places.find(*key);
    if (place == places.end()) return;
    LoggedOpportunity& o = opportunities[place->second];
    if (o.probability) return;  // the robot took one possession for two: chance decided with the first
    o.policy = row.get<std::string>("policy");
    o.probability = row.get<double>("probability");
  });
}

void see_opportunities(const log::Reader& reader, const SessionPlaces& sessions, const TruthCount& truths,
                       SeenRows& seen) {
  // The goal's middle is the same all over a log; a log without a kick needs no distance.
  std::optional<double> goal_y_m;
  reader.query("SELECT max(target_y_m) FROM (SELECT target_y_m FROM kick_decisions LIMIT 1000)",
               [&](std::optional<double> y_m) { goal_y_m = y_m; });
  PossessionPlaces places;  // with the session in the play's place
  reader.query(kOpportunitiesSql, [&](const log::NamedCells& row) {
    const auto x_m = row.get<double>("start_x_m");
    const auto session = sessions.find(row.get<std::int64_t>("session_id"));
    if (session == sessions.end()) return;
    const PossessionKey key{session->second, row.get<int>("robot_id"), row.get<int>("half"),
                            row.get<std::int64_t>("possession_id")};
    LoggedOpportunity o;
    std::tie(o.session, o.robot_id, o.half, o.possession_id) = key;
    o.policy = row.find<std::string>("policy").value_or("");
    o.start_x_m = x_m;
    if (goal_y_m) o.start_distance_m = std::hypot(x_m, *goal_y_m - row.get<double>("start_y_m"));
    places[key] = seen.opportunities.size();
    seen.opportunities.push_back(std::move(o));
  });
  see_assigned(reader, sessions, truths, places, seen.opportunities);
  reader.query(kFirstDecisionsSql, [&](const log::NamedCells& row) {
    const auto key = possession_of(row, sessions, truths);
    if (!key) return;
    const auto place = places.find(*key);
    if (place == places.end() || seen.opportunities[place->second].first) return;
    seen.opportunities[place->second].first = {row.get<double>("distance_m"), row.get<double>("x_m"),
                                               row.find<double>("opponent_distance_m")};
  });
}

void see_kicks(const log::Reader& reader, const SessionPlaces& sessions, const TruthCount& truths, bool truth,
               SeenRows& seen) {
  reader.query(kComparedKicksSql, [&](const log::NamedCells& row) {
    const auto key = possession_of(row, sessions, truths);
    if (!key) return;
    const auto& [session, robot_id, half, own_id] = *key;
    auto truth_outcome = row.find<std::string>("truth_outcome");
    seen.kicks.push_back({.session = session,
                          .robot_id = robot_id,
                          .half = half,
                          .possession_id = row.find<std::int64_t>("true_possession_id").value_or(own_id),
                          .policy = row.get<std::string>("policy"),
                          .outcome = std::move(truth ? truth_outcome : row.find<std::string>("outcome")).value_or(""),
                          .distance_m = row.find<double>("distance_m"),
                          .kick_id = row.get<std::int64_t>("kick_id"),
                          .p_inside = truth ? std::nullopt : row.find<double>("observed_p_on_target"),
                          .said = {.bounced = row.find<bool>("bounced"),
                                   .truth_bounced = row.find<bool>("truth_bounced"),
                                   .saved = row.find<bool>("saved"),
                                   .truth_saved = row.find<bool>("truth_saved"),
                                   .by_people = row.get<bool>("label_says_goals")}});
  });
}

// What a recording lacks another one of the play may have.
void complete(LoggedOpportunity& o, LoggedOpportunity&& other) {
  if (o.policy.empty()) o.policy = std::move(other.policy);
  if (!o.probability) o.probability = other.probability;
  if (!o.start_x_m) o.start_x_m = other.start_x_m;
  if (!o.start_distance_m) o.start_distance_m = other.start_distance_m;
  if (!o.first) o.first = other.first;
}

PossessionPlaces add_opportunities(std::vector<LoggedOpportunity>&& opportunities, LoggedOpportunities& logged) {
  PossessionPlaces places;
  for (LoggedOpportunity& o : opportunities) {
    const ComparedSession& session = logged.sessions[o.session];
    if (!session.counts || session.halves_left_out.contains(o.half)) continue;
    const auto [place, added] =
        places.try_emplace({session.play, o.robot_id, o.half, o.possession_id}, logged.rows.size());
    if (added) {
      logged.rows.push_back(std::move(o));
    } else {
      complete(logged.rows[place->second], std::move(o));
    }
  }
  return places;
}

void add_kicks(const PossessionPlaces& places, bool truth, LoggedOpportunities& logged) {
  std::int64_t alone = 0;
  std::array<std::int64_t, kNoGoals.size()> no_goals{};
  for (const CountedKick& kick : logged.kicks) {
    const ComparedSession& session = logged.sessions[kick.session];
    const auto place = places.find({session.play, kick.robot_id, kick.half, kick.possession_id});
    if (place == places.end()) {
      LoggedOpportunity& o = logged.rows.emplace_back();
      std::tie(o.session, o.robot_id, o.half, o.possession_id) =
          std::tie(kick.session, kick.robot_id, kick.half, kick.possession_id);
      o.has_possession = false;
      ++alone;
    }
    LoggedOpportunity& o = place == places.end() ? logged.rows.back() : logged.rows[place->second];
    o.policy = kick.policy;  // of two kicks of a possession the later one
    // The simulator settles every ball that left; without its word there was none in front of the kicker.
    const bool no_ball = truth && kick.outcome.empty() && session.simulated;
    o.ending = no_ball ? Ending::kNoKick : ending_of(kick.outcome);
    o.distance_m = kick.distance_m;
    for (std::size_t i = 0; i < kNoGoals.size(); ++i) no_goals[i] += kick.outcome == kNoGoals[i].label ? 1 : 0;
    o.doubt = !kick.p_inside || is_no_goal(kick.outcome) ? 0.0
              : o.ending == Ending::kInside              ? 1.0 - *kick.p_inside
              : o.ending == Ending::kOutside             ? *kick.p_inside
                                                         : 0.0;
    o.blocked = kick.outcome == "blocked";
    o.said = kick.said;
  }
  for (std::size_t i = 0; i < kNoGoals.size(); ++i) {
    if (no_goals[i] == 0) continue;
    const bool one = no_goals[i] == 1;
    logged.not_counted.push_back(
        fmt::format("{} {} on target {} {} outside: the rules of the session count no such goal", no_goals[i],
                    one ? "kick" : "kicks", kNoGoals[i].where, one ? "is" : "are"));
    logged.remarks.push_back(logged.not_counted.back());
  }
  if (alone > 0 && !places.empty()) {
    logged.remarks.push_back(
        fmt::format("{} {} to no possession that the log knows", alone, alone == 1 ? "kick belongs" : "kicks belong"));
  }
}

// One log after the other, and then everything together.
class OpportunityReading {
 public:
  explicit OpportunityReading(bool truth) : truth_(truth) {}

  SessionPlaces add(const log::Reader& reader, const std::string& name) {
    SessionPlaces fresh = sessions_read_.add(reader, name);
    logged_.logs.push_back(name);
    const TruthCount truths(reader);
    see_opportunities(reader, fresh, truths, seen_);
    see_kicks(reader, fresh, truths, truth_, seen_);
    read_play(reader, fresh, truths, seen_.play);
    reader.query("SELECT count(*) FROM assignments WHERE possession_id = 0 AND probability < 1.0",
                 [&](std::int64_t draws) { logged_.draws_of_halves += draws; });
    std::int64_t missing = 0;
    for (const log::Loss& loss : reader.losses()) missing += loss.missing();
    if (missing > 0)
      losses_.push_back(fmt::format("{}: {} rows are missing (trivela report says which)", name, missing));
    note_lengths(reader, name, fresh);
    return fresh;
  }

  const SessionIndex& sessions_read() const { return sessions_read_; }

  void settle() { sessions_read_.settle(); }

  LoggedOpportunities finish() && {
    logged_.sessions = sessions_read_.sessions();
    logged_.matches = sessions_read_.matches();
    logged_.not_counted = sessions_read_.not_counted();
    logged_.remarks = sessions_read_.remarks();
    logged_.remarks.insert(logged_.remarks.end(), logged_.not_counted.begin(), logged_.not_counted.end());
    const PossessionPlaces places = add_opportunities(std::move(seen_.opportunities), logged_);
    logged_.kicks = std::move(seen_.kicks);
    std::erase_if(logged_.kicks, [&](const CountedKick& kick) {
      return !sessions_read_.counts(kick.session, kick.robot_id, kick.kick_id);
    });
    add_kicks(places, truth_, logged_);
    logged_.remarks.insert(logged_.remarks.end(), losses_.begin(), losses_.end());
    remark_lengths();
    logged_.spans = played_spans(seen_.play, logged_);
    return std::move(logged_);
  }

 private:
  // Each recording by itself: which ones are of one play is known when all are read.
  void note_lengths(const log::Reader& reader, const std::string& name, const SessionPlaces& fresh) {
    std::vector<ComparedSession> alone;
    for (const ComparedSession& session : sessions_read_.sessions()) {
      alone.push_back(session);
      alone.back().play = static_cast<std::uint32_t>(alone.size());
    }
    const log::Reader* const log = &reader;
    for (const PlayedLength& length : played_lengths(std::span(&log, 1), alone)) {
      const auto session = fresh.find(length.session_id);
      if (session == fresh.end()) continue;
      for (const std::string& line : cut_short_lines({length}))
        cut_short_.emplace_back(session->second, fmt::format("{}: {}", name, line));
    }
  }

  // Of a play with several recordings one may have what another lacks.
  void remark_lengths() {
    for (const auto& [place, line] : cut_short_) {
      const ComparedSession& session = logged_.sessions[place];
      if (session.counts && std::ranges::count(logged_.sessions, session.play, &ComparedSession::play) == 1)
        logged_.remarks.push_back(line);
    }
  }

  bool truth_;
  SessionIndex sessions_read_;
  SeenRows seen_;
  LoggedOpportunities logged_;
  std::vector<std::string> losses_;
  std::vector<std::pair<std::uint32_t, std::string>> cut_short_;  // by place of the session
};

void append(std::vector<log::GivenLabel>& all, std::vector<log::GivenLabel> more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace

LoggedOpportunities read_opportunities(const std::vector<std::filesystem::path>& logs, bool truth) {
  OpportunityReading reading(truth);
  std::vector<log::GivenLabel> labels;
  for (const std::filesystem::path& path : logs)
    if (logs.size() > 1) append(labels, log::Reader(path, log::Check::kSchema).labels());
  for (const std::filesystem::path& path : logs) {
    log::Reader reader(path);
    reader.read_labels(labels);
    reading.add(reader, path.string());
  }
  reading.sessions_read().refuse_replays_alone();
  reading.settle();
  return std::move(reading).finish();
}

LoggedOpportunities read_opportunities(std::span<const OpenLog> logs, bool truth) {
  OpportunityReading reading(truth);
  std::vector<SessionPlaces> places;
  std::vector<log::GivenLabel> labels;
  for (const OpenLog& log : logs)
    if (logs.size() > 1) append(labels, log.reader->labels());
  for (const OpenLog& log : logs) log.reader->read_labels(labels);
  for (const OpenLog& log : logs) places.push_back(reading.add(*log.reader, log.name));
  reading.settle();
  for (std::size_t i = 0; i < logs.size(); ++i) {
    std::vector<std::int64_t> left_out = reading.sessions_read().sessions_left_out(places[i]);
    logs[i].reader->query("SELECT session_id FROM sessions", [&](std::int64_t session_id) {
      if (!places[i].contains(session_id)) left_out.push_back(session_id);
    });
    logs[i].reader->leave_out(left_out, reading.sessions_read().kicks_left_out(places[i]));
  }
  return std::move(reading).finish();
}

LoggedOpportunities read_opportunities(log::Reader& reader, const std::string& name, bool truth) {
  const OpenLog log{&reader, name};
  return read_opportunities(std::span(&log, 1), truth);
}

}  // namespace trivela::evaluator
