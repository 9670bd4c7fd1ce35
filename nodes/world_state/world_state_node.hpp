#pragma once

#include <mutex>

#include "nodes/runtime/node_context.hpp"
#include "robot/belief/field_watch.hpp"
#include "robot/belief/world_model.hpp"
#include "robot/watch/referee_watch.hpp"

namespace trivela::nodes {

/// Odometry in, with the newest vision frame, the referee's word and what the kicker did last; WorldState out. Nobody
/// plays by the word of a referee who has fallen silent. Warns where the belief contradicts the field of the settings.
class WorldStateNode {
 public:
  explicit WorldStateNode(NodeContext& context);
  bus::Node& node() { return node_; }

 private:
  void on_odometry(const msg::Odometry& odometry);
  void trust_no_silence(std::optional<msg::Referee>& word);
  void warn_of_contradictions(const msg::WorldState& world, const msg::Referee* referee);

  NodeContext& context_;
  robot::WorldModel model_;
  robot::FieldWatch field_watch_;
  robot::GoalWatch goal_watch_;
  robot::ReachWatch reach_watch_;
  bus::Node node_;
  bus::Output<msg::WorldState> world_out_;
  std::shared_ptr<bus::Mailbox<msg::VisionFrame>> vision_;
  std::mutex referee_mutex_;
  robot::RefereeWatch referee_watch_;  // real time
  std::shared_ptr<bus::Mailbox<msg::Referee>> referee_;
  std::shared_ptr<bus::Mailbox<msg::KickerStatus>> kicker_;
  FirstCycle first_;
  std::uint64_t seq_ = 0;
};

}  // namespace trivela::nodes
