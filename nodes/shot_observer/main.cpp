#include "nodes/runtime/node_main.hpp"
#include "nodes/shot_observer/shot_observer_node.hpp"

int main(int argc, char** argv) {
  return trivela::nodes::node_main(argc, argv, "shot_observer", [](trivela::nodes::NodeContext& context) {
    trivela::nodes::ShotObserverNode node{context};
    trivela::nodes::run(context, node.node());
  });
}
