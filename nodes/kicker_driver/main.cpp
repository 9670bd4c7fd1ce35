#include "hal/open.hpp"
#include "nodes/kicker_driver/kicker_driver_node.hpp"
#include "nodes/runtime/node_main.hpp"

int main(int argc, char** argv) {
  return trivela::nodes::node_main(argc, argv, "kicker_driver", [](trivela::nodes::NodeContext& context) {
    trivela::nodes::KickerDriverNode node{
        context, trivela::hal::open_kicker(context.settings.hal, {context.participant, context.robot_id()})};
    trivela::nodes::run(context, node.node());
  });
}
