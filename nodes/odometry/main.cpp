#include "hal/open.hpp"
#include "nodes/odometry/odometry_node.hpp"
#include "nodes/runtime/node_main.hpp"

int main(int argc, char** argv) {
  return trivela::nodes::node_main(argc, argv, "odometry", [](trivela::nodes::NodeContext& context) {
    trivela::nodes::OdometryNode node{
        context, trivela::hal::open_wheels(context.settings.hal, {context.participant, context.robot_id()})};
    trivela::nodes::run(context, node.node());
  });
}
