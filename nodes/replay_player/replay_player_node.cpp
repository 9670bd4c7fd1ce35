#include "nodes/replay_player/replay_player_node.hpp"

#include <fmt/core.h>

#include <optional>
#include <type_traits>
#include <variant>

#include "kicking/geometry/time.hpp"
#include "nodes/runtime/node_main.hpp"
#include "nodes/runtime/progress_line.hpp"
#include "nodes/runtime/readers.hpp"

namespace trivela::nodes {
namespace {

std::int64_t last_t_ns(const hal::ReplayLog& log) {
  std::int64_t last = 0;
  log.reader->query(fmt::format("SELECT max(t_ns) FROM referee WHERE session_id = {}", log.session_id),
                    [&](std::optional<std::int64_t> t_ns) { last = t_ns.value_or(0); });
  return last;
}

}  // namespace

ReplayPlayerNode::ReplayPlayerNode(NodeContext& context)
    : context_(context),
      log_(hal::ReplayLog::open(context.settings.hal.replay_log, context.robot_id())),
      topics_(log_),
      vision_(context.participant),
      flight_(context.participant),
      referee_(context.participant, referee_of(context.robot_id())),
      barrier_(context.participant, context.robot_id()) {
  for (const auto& session : log_.reader->sessions())
    if (session.session_id == log_.session_id) hal::require_lockstep(session, context.settings.hal.replay_log);
}

void ReplayPlayerNode::run() {
  const bool heard = readers_before_stop(context_, vision_) && readers_before_stop(context_, flight_) &&
                     readers_before_stop(context_, referee_);
  if (!heard) return;
  ProgressLine progress;
  const double total_s = kicking::seconds(last_t_ns(log_));
  while (const auto t_ns = topics_.next_t_ns()) {
    context_.alive();
    while (topics_.next_t_ns() == t_ns) publish(*topics_.next());
    if (!barrier_.wait_for(*t_ns, context_.stop)) return;
    progress.say(kicking::seconds(*t_ns), total_s, topics_.ended());
  }
}

void ReplayPlayerNode::publish(const hal::ReplayedSample& sample) {
  const auto say = [&]<class T>(const T& message) {
    if constexpr (std::is_same_v<T, msg::VisionFrame>) vision_.write(message);
    if constexpr (std::is_same_v<T, msg::FlightFrame>) flight_.write(message);
    if constexpr (std::is_same_v<T, msg::Referee>) referee_.write(message);
  };
  std::visit(say, sample);
}

int replay_player_main(int argc, char** argv) {
  return node_main(argc, argv, "replay_player", [](NodeContext& context) {
    ReplayPlayerNode node{context};
    node.run();
  });
}

}  // namespace trivela::nodes
