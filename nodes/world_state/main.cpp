#include "nodes/runtime/node_main.hpp"
#include "nodes/world_state/world_state_node.hpp"

int main(int argc, char** argv) {
  return trivela::nodes::node_main(argc, argv, "world_state", [](trivela::nodes::NodeContext& context) {
    trivela::nodes::WorldStateNode node{context};
    trivela::nodes::run(context, node.node());
  });
}
