#include "hal/open.hpp"
#include "nodes/kick_decision/kick_decision_node.hpp"
#include "nodes/odometry/odometry_node.hpp"
#include "nodes/runtime/node_main.hpp"
#include "nodes/world_state/world_state_node.hpp"

namespace trivela::nodes {

/// odometry, world_state and kick_decision as one member of the bus: what one of them says is handed to the others
/// without a datagram, in the thread that said it. kicker_driver stays a process of its own, since it must outlive
/// them.
int chain_main(int argc, char** argv) {
  return node_main(argc, argv, "chain", [](NodeContext& context) {
    OdometryNode odometry{
        context, hal::open_wheels(context.settings.hal, {context.participant, context.robot_id(), context.robot.base})};
    WorldStateNode world_state{context};
    KickDecisionNode kick_decision{context};
    run(context, {&odometry.node(), &world_state.node(), &kick_decision.node()});
  });
}

}  // namespace trivela::nodes
