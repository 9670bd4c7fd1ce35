#include "nodes/replay_player/replay_player_node.hpp"
#include "nodes/runtime/node_main.hpp"

int main(int argc, char** argv) {
  return trivela::nodes::node_main(argc, argv, "replay_player", [](trivela::nodes::NodeContext& context) {
    trivela::nodes::ReplayPlayerNode node{context};
    node.run();
  });
}
