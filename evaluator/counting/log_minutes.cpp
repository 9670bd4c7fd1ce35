#include "evaluator/counting/log_minutes.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include "evaluator/metrics/assigned_possessions.sql.hpp"
#include "evaluator/metrics/played_spans.sql.hpp"

namespace trivela::evaluator {
namespace {

using Possession = std::tuple<std::uint32_t, int, std::int64_t>;  // play, half, number
using Holders = std::set<PolicyOfRobot>;

/// The time that spans cover together, of which so much was played as in the spans on average.
double minutes_of(std::vector<const RecordedSpan*> spans) {
  std::ranges::sort(spans, {}, [](const RecordedSpan* span) { return span->from_ns; });
  double covered_ns = 0.0, sum_ns = 0.0, played_ns = 0.0;
  std::optional<std::int64_t> end_ns;
  for (const RecordedSpan* const span : spans) {
    const std::int64_t from_ns = std::max(span->from_ns, end_ns.value_or(span->from_ns));
    end_ns = std::max(span->to_ns, end_ns.value_or(span->to_ns));
    covered_ns += static_cast<double>(std::max<std::int64_t>(*end_ns - from_ns, 0));
    sum_ns += static_cast<double>(span->to_ns - span->from_ns);
    played_ns += static_cast<double>(span->played_ns);
  }
  return sum_ns > 0.0 ? played_ns / sum_ns * covered_ns / 60e9 : 0.0;
}

/// Who the session says is in charge of a half, for robots of whom nothing more is known.
class PoliciesOfHalves {
 public:
  PoliciesOfHalves(const std::vector<PolicyOfHalf>& policies, const LoggedOpportunities& logged) {
    for (const PolicyOfHalf& half : policies) said_[{half.session, half.half}][half.who.robot_id] = half.who.policy;
    for (const LoggedOpportunity& o : logged.rows) robots_[o.session].insert(o.robot_id);
  }

  /// The policy that all robots of the session have in a half; none: they differ, or nobody says it.
  std::optional<PolicyOfRobot> only(std::uint32_t session, int half) const {
    const auto said = said_.find({session, half});
    if (said == said_.end()) return std::nullopt;
    std::set<std::string> policies;
    const auto robots = robots_.find(session);
    for (const int robot_id : robots == robots_.end() ? std::set<int>{0} : robots->second) {
      const auto own = said->second.find(robot_id);
      const auto any = own != said->second.end() ? own : said->second.find(0);
      if (any == said->second.end()) return std::nullopt;
      policies.insert(any->second);
    }
    if (policies.size() != 1) return std::nullopt;
    const bool one = robots != robots_.end() && robots->second.size() == 1;
    return PolicyOfRobot{one ? *robots->second.begin() : 0, *policies.begin()};
  }

 private:
  std::map<std::pair<std::uint32_t, int>, std::map<int, std::string>> said_;  // by session and half, and by robot
  std::map<std::uint32_t, std::set<int>> robots_;                             // by session
};

}  // namespace

TruthCount::TruthCount(const log::Reader& reader) {
  using Start = std::pair<std::int64_t, std::int64_t>;  // of play in a possession, and its number
  std::map<std::tuple<std::int64_t, int, int>, std::vector<Start>> starts;
  reader.query(
      "SELECT session_id, robot_id, half, possession_id, start_t_ns FROM possession_truths ORDER BY start_t_ns",
      [&](std::int64_t session_id, int robot_id, int half, std::int64_t number, std::int64_t start_t_ns) {
        sessions_.insert(session_id);
        starts[{session_id, robot_id, half}].emplace_back(start_t_ns, number);
      });
  if (starts.empty()) return;
  reader.query(kAssignedPossessionsSql, [&](const log::NamedCells& row) {
    const auto session_id = row.get<std::int64_t>("session_id");
    const auto robot_id = row.get<int>("robot_id");
    const auto half = row.get<int>("half");
    const auto own = row.get<std::int64_t>("possession_id");
    const auto t_ns = row.find<std::int64_t>("t_ns");
    const auto of_robot = starts.find({session_id, robot_id, half});
    if (!t_ns || of_robot == starts.end()) return;
    const auto later = std::ranges::upper_bound(of_robot->second, *t_ns, {}, &Start::first);
    if (later == of_robot->second.begin()) return;
    const std::int64_t number = std::prev(later)->second;
    if (number != own) other_[{session_id, robot_id, half, own}] = number;
  });
}

std::int64_t TruthCount::number(std::int64_t session_id, int robot_id, int half, std::int64_t own) const {
  const auto other = other_.find({session_id, robot_id, half, own});
  return other == other_.end() ? own : other->second;
}

void read_play(const log::Reader& reader, const SessionPlaces& sessions, const TruthCount& truths,
               RecordedPlay& received) {
  reader.query(kPlayedSpansSql, [&](const log::NamedCells& row) {
    const auto session_id = row.get<std::int64_t>("session_id");
    const auto of_robot = row.find<int>("of_robot");
    const auto half = row.get<int>("half");
    const auto possession_id = row.get<std::int64_t>("possession_id");
    const auto session = sessions.find(session_id);
    if (session == sessions.end()) return;
    const std::int64_t id = of_robot ? truths.number(session_id, *of_robot, half, possession_id) : possession_id;
    received.spans.push_back({session->second, of_robot.value_or(0), half, id, row.get<std::int64_t>("from_ns"),
                              row.get<std::int64_t>("to_ns"), row.get<std::int64_t>("played_ns")});
  });
  reader.query("SELECT session_id, half, robot_id, policy FROM session_policies",
               [&](std::int64_t session_id, int half, int robot_id, const std::string& policy) {
                 const auto session = sessions.find(session_id);
                 if (session != sessions.end())
                   received.policies.push_back({session->second, half, {robot_id, policy}});
               });
}

std::vector<PlayedSpan> played_spans(const RecordedPlay& received, const LoggedOpportunities& logged) {
  std::map<Possession, Holders> holders;
  for (const LoggedOpportunity& o : logged.rows) {
    if (o.possession_id == 0) continue;
    holders[{logged.sessions[o.session].play, o.half, o.possession_id}].insert({o.robot_id, o.policy});
  }
  const PoliciesOfHalves halves(received.policies, logged);
  std::map<std::pair<Possession, int>, std::vector<const RecordedSpan*>> spans;  // and by robot that counts its own
  for (const RecordedSpan& span : received.spans) {
    const ComparedSession& session = logged.sessions[span.session];
    if (session.counts && !session.halves_left_out.contains(span.half))
      spans[{{session.play, span.half, span.possession_id}, span.of_robot}].push_back(&span);
  }
  std::vector<PlayedSpan> played;
  for (const auto& [key, recorded] : spans) {
    const auto& [possession, of_robot] = key;
    PlayedSpan span{recorded.front()->session, recorded.front()->half, minutes_of(recorded), {}};
    if (const auto had = holders.find(possession); had != holders.end()) {
      for (const PolicyOfRobot& who : had->second) {
        if (of_robot == 0 || who.robot_id == of_robot) span.had_it.push_back(who);
      }
    }
    if (span.had_it.empty()) {
      if (const auto only = halves.only(span.session, span.half)) span.had_it.push_back(*only);
    }
    if (span.minutes > 0.0) played.push_back(std::move(span));
  }
  return played;
}

}  // namespace trivela::evaluator
