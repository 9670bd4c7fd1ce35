#include "nodes/kick_decision/kick_decision_node.hpp"
#include "nodes/runtime/node_main.hpp"

int main(int argc, char** argv) {
  return trivela::nodes::node_main(argc, argv, "kick_decision", [](trivela::nodes::NodeContext& context) {
    trivela::nodes::KickDecisionNode node{context};
    trivela::nodes::run(context, node.node());
  });
}
