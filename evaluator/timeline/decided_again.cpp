#include "evaluator/timeline/decided_again.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "evaluator/render/text_table.hpp"

namespace trivela::evaluator {
namespace {

constexpr double kSameCycle_s = 1e-3;

/// Half and possession of a robot from an instant on.
using Possessions = std::map<std::int64_t, std::pair<int, std::int64_t>>;

/// By the belief that was recorded: a replay with other settings may count otherwise.
Possessions possessions_of(const log::Reader& reader, std::int64_t session_id, int robot_id) {
  Possessions changes;
  std::optional<std::pair<int, std::int64_t>> last;
  reader.query(
      fmt::format(
          "SELECT t_ns, half, possession_id FROM world_states WHERE session_id = {} AND robot_id = {} ORDER BY seq",
          session_id, robot_id),
      [&](std::int64_t t_ns, int half, std::int64_t possession_id) {
        if (last == std::pair{half, possession_id}) return;
        last = {half, possession_id};
        changes[t_ns] = *last;
      });
  return changes;
}

/// Robot, half and possession.
using Key = std::tuple<int, int, std::int64_t>;

/// Calls fn(robot, half, possession, order, refused) for each order of a session in the order of time.
template <class F>
void each_order(const log::Reader& reader, const log::RecordedSession& session, F&& fn) {
  const std::int64_t started_t_ns = session.started_t_ns;
  reader.query(
      fmt::format("SELECT robot_id, half, possession_id, t_ns, kick_id & 0xffffffffff AS number, policy, power, "
                  "p_on_target, accepted, label FROM labelled_kicks WHERE session_id = {} ORDER BY robot_id, t_ns",
                  session.session_id),
      [&](const log::NamedCells& row) {
        const auto t_ns = row.get<std::int64_t>("t_ns");
        const bool refused = row.find<bool>("accepted") == false;
        fn(Key{row.get<int>("robot_id"), row.get<int>("half"), row.get<std::int64_t>("possession_id")}, t_ns,
           PossessionOrder{1e-9 * static_cast<double>(t_ns - started_t_ns), row.get<std::int64_t>("number"),
                           row.get<std::string>("policy"), row.find<double>("power"), row.find<double>("p_on_target"),
                           refused ? "refused" : row.find<std::string>("label").value_or("")},
           refused);
      });
}

DecidedAgain beside(const OpenLog& log, const log::RecordedSession& session, const OpenLog& again_log,
                    const log::RecordedSession& replay) {
  DecidedAgain again{.uuid = session.uuid, .log = log.name, .again_log = again_log.name, .orders = {}};
  std::map<Key, PossessionOrders> found;
  const auto place = [&](const Key& key) -> PossessionOrders& {
    PossessionOrders& both = found[key];
    std::tie(both.robot_id, both.half, both.possession_id) = key;
    return both;
  };
  std::map<Key, bool> was_refused;
  each_order(*log.reader, session, [&](const Key& key, std::int64_t, PossessionOrder order, bool refused) {
    PossessionOrders& both = place(key);
    if (both.recorded && !(was_refused[key] && !refused)) return;
    was_refused[key] = refused;
    both.recorded = std::move(order);
  });
  std::map<int, Possessions> possessions;
  each_order(*again_log.reader, replay, [&](Key key, std::int64_t t_ns, PossessionOrder order, bool) {
    const auto [of_robot, fresh] = possessions.try_emplace(std::get<0>(key));
    if (fresh) of_robot->second = possessions_of(*log.reader, session.session_id, std::get<0>(key));
    auto then = of_robot->second.upper_bound(t_ns);
    if (then != of_robot->second.begin()) std::tie(std::get<1>(key), std::get<2>(key)) = (--then)->second;
    PossessionOrders& both = place(key);
    if (!both.replayed) both.replayed = std::move(order);
  });
  log.reader->query(fmt::format("SELECT count(*) FROM (SELECT DISTINCT robot_id, half, possession_id FROM "
                                "kick_decisions WHERE session_id = {} AND reason <> 'not_playing')",
                                session.session_id),
                    [&](std::int64_t count) { again.possessions = count; });
  for (auto& [key, both] : found) again.orders.push_back(std::move(both));
  const auto instant = [](const PossessionOrders& both) {
    return (both.recorded ? both.recorded : both.replayed)->at_s;
  };
  std::ranges::stable_sort(again.orders, {},
                           [&](const PossessionOrders& t) { return std::pair(t.robot_id, instant(t)); });
  return again;
}

std::string number_text(const std::optional<double>& number, const char* form) {
  return number ? fmt::format(fmt::runtime(form), *number) : "–";
}

}  // namespace

std::vector<DecidedAgain> decided_again(const std::vector<OpenLog>& logs) {
  std::map<std::string, std::pair<const OpenLog*, log::RecordedSession>> recorded;
  for (const OpenLog& log : logs)
    for (log::RecordedSession& session : log.reader->sessions())
      if (session.replays_uuid.empty()) recorded.try_emplace(session.uuid, &log, std::move(session));
  std::vector<DecidedAgain> all;
  for (const OpenLog& log : logs) {
    for (const log::RecordedSession& replay : log.reader->sessions()) {
      const auto original = recorded.find(replay.replays_uuid);
      if (replay.replays_uuid.empty() || original == recorded.end()) continue;
      all.push_back(beside(*original->second.first, original->second.second, log, replay));
    }
  }
  return all;
}

std::vector<std::string> sentences_of(const DecidedAgain& again) {
  std::int64_t same = 0, earlier = 0, later = 0, only_recorded = 0, only_replayed = 0;
  for (const PossessionOrders& both : again.orders) {
    if (!both.replayed) {
      ++only_recorded;
    } else if (!both.recorded) {
      ++only_replayed;
    } else {
      const double by_s = both.replayed->at_s - both.recorded->at_s;
      ++(std::abs(by_s) < kSameCycle_s ? same : by_s < 0.0 ? earlier : later);
    }
  }
  return {
      "Open loop: robot, ball, opponents and kicker go on as recorded, whatever the replay orders. No kick of the "
      "replay was made, and none has an outcome.",
      fmt::format("Of {} possessions with a decision, {} have an order in both: {} in the same cycle, {} earlier in "
                  "the replay, {} later. {} have one only as recorded, {} only in the replay.",
                  again.possessions, same + earlier + later, same, earlier, later, only_recorded, only_replayed)};
}

std::vector<std::vector<std::string>> table_of(const DecidedAgain& again) {
  std::vector<std::vector<std::string>> rows{{"robot", "half", "possession", "recorded: kick", "at [s]", "policy",
                                              "power", "predicted", "became", "replayed: at [s]", "policy", "power",
                                              "predicted"}};
  for (const PossessionOrders& both : again.orders) {
    std::vector<std::string> row{std::to_string(both.robot_id), std::to_string(both.half),
                                 std::to_string(both.possession_id)};
    const auto add = [&](const std::optional<PossessionOrder>& order, bool recorded) {
      const auto text = [&](const std::string& words) { row.push_back(order ? words : "–"); };
      if (recorded) text(order ? fmt::format("{}:{}", both.robot_id, order->number) : "");
      text(order ? fmt::format("{:.2f}", order->at_s) : "");
      text(order ? order->policy : "");
      text(order ? number_text(order->power, "{:.1f}") : "");
      text(order ? number_text(order->p_on_target, "{:.2f}") : "");
      if (recorded) text(order ? (order->became.empty() ? "unknown" : words(order->became)) : "");
    };
    add(both.recorded, true);
    add(both.replayed, false);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace trivela::evaluator
