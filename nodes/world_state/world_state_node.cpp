#include "nodes/world_state/world_state_node.hpp"

#include "nodes/runtime/node_main.hpp"
#include "nodes/runtime/readers.hpp"

namespace trivela::nodes {

WorldStateNode::WorldStateNode(NodeContext& context)
    : context_(context),
      model_(context.settings.world_state, context.robot.model.ball_offset_m),
      field_watch_(context.settings.goal.y_m, context.settings.field.side_line_x_m),
      goal_watch_(context.settings.goal),
      reach_watch_(context.settings.goal.y_m, context.settings.field.side_line_x_m),
      node_(context.participant, "world_state", context.robot_id()),
      world_out_(node_.writer<msg::WorldState>()),
      vision_(node_.stores<msg::VisionFrame>()),
      referee_watch_(context.settings.run.referee_timeout_s),
      referee_(node_.stores<msg::Referee>(
          {.period = {},
           .keep_all = false,
           .on_liveliness = [this](const bus::Liveliness& writers) { referee_watch_.writers(writers.alive); }},
          [this](const msg::Referee& word, const bus::SampleInfo& info) {
            const std::lock_guard lock{referee_mutex_};
            referee_watch_.received(word, context_.steady_ns(), info.writer);
          })),
      kicker_(node_.stores<msg::KickerStatus>()),
      first_(context.settings.run.lockstep) {
  reject_duplicate_node(context_, world_out_, "world_state");
  node_.on<msg::Odometry>([this](const msg::Odometry& odometry) { on_odometry(odometry); },
                          bus::writes<msg::WorldState>());
}

void WorldStateNode::on_odometry(const msg::Odometry& odometry) {
  first_.once([this] { expect_readers(context_, world_out_); });
  if (!context_.participant.believes(odometry.t_ns)) return;
  auto frame = input_of_cycle(context_, *vision_, odometry.t_ns);
  // It would make all pictures old that follow.
  if (frame && !context_.participant.believes(frame->t_exposure_ns)) frame.reset();
  auto referee = input_of_cycle(context_, *referee_, odometry.t_ns);
  if (!context_.settings.run.lockstep) trust_no_silence(referee);
  const auto kicker = input_of_cycle(context_, *kicker_, odometry.t_ns);
  msg::WorldState world =
      model_.update(odometry, frame ? &*frame : nullptr, referee ? &*referee : nullptr, kicker ? &*kicker : nullptr);
  world.robot_id = context_.robot_id();
  world.seq = ++seq_;
  world_out_.write(world);
  warn_of_contradictions(world, referee ? &*referee : nullptr);
}

/// Where the belief does not fit the settings' field. In lockstep the simulated world has the same field, and nobody is
/// to be told that its possessions keep off the lines.
void WorldStateNode::warn_of_contradictions(const msg::WorldState& world, const msg::Referee* referee) {
  for (const std::string& sentence : field_watch_.see(world)) context_.logger->warn("{}", sentence);
  if (const auto sentence = goal_watch_.see(world, referee)) context_.logger->warn("{}", *sentence);
  if (context_.settings.run.lockstep) return;
  if (const auto sentence = reach_watch_.see(world)) context_.logger->warn("{}", *sentence);
}

/// In real time the word is the last one that came, however long ago.
void WorldStateNode::trust_no_silence(std::optional<msg::Referee>& word) {
  if (!word) return;
  const std::int64_t now_ns = context_.steady_ns();
  const std::lock_guard lock{referee_mutex_};
  if (const auto news = referee_watch_.news(now_ns)) context_.logger->warn(*news);
  word->playing = referee_watch_.says(now_ns) == robot::RefereePermission::kPlay;
}

int world_state_main(int argc, char** argv) {
  return node_main(argc, argv, "world_state", [](NodeContext& context) {
    WorldStateNode node{context};
    run(context, node.node());
  });
}

}  // namespace trivela::nodes
