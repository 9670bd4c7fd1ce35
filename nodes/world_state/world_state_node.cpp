#include "nodes/world_state/world_state_node.hpp"

namespace trivela::nodes {

WorldStateNode::WorldStateNode(NodeContext& context)
    : context_(context),
      model_(context.settings.world_state, context.robot.model.ball_offset_m),
      node_(context.participant, "world_state", context.robot_id()),
      world_out_(node_.writer<msg::WorldState>()),
      vision_(node_.stores<msg::VisionFrame>()),
      referee_(node_.stores<msg::Referee>()),
      first_(context.settings.run.lockstep) {
  refuse_twin(context_, world_out_, "world_state");
  node_.on<msg::Odometry>([this](const msg::Odometry& odometry) { on_odometry(odometry); },
                          bus::writes<msg::WorldState>());
}

void WorldStateNode::on_odometry(const msg::Odometry& odometry) {
  first_.once([this] {
    expect_readers(world_out_, 2);  // kick_decision, recorder
  });
  if (!context_.participant.believes(odometry.t_ns)) return;
  auto frame = input_of_cycle(context_, *vision_, odometry.t_ns);
  // It would make all pictures old that follow.
  if (frame && !context_.participant.believes(frame->t_exposure_ns)) frame.reset();
  const auto referee = input_of_cycle(context_, *referee_, odometry.t_ns);
  msg::WorldState world = model_.update(odometry, frame ? &*frame : nullptr, referee ? &*referee : nullptr);
  world.robot_id = context_.robot_id();
  world.seq = ++seq_;
  world_out_.write(world);
}

}  // namespace trivela::nodes
