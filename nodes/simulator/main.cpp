#include "nodes/runtime/node_main.hpp"
#include "nodes/simulator/simulator_node.hpp"

int main(int argc, char** argv) {
  return trivela::nodes::node_main(argc, argv, "simulator", [](trivela::nodes::NodeContext& context) {
    trivela::nodes::SimulatorNode node{context};
    node.run();
    context.logger->info("played {:.1f} s", node.played_s());
  });
}
