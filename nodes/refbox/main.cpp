#include "nodes/refbox/refbox_node.hpp"
#include "nodes/runtime/node_main.hpp"

namespace trivela::nodes {

int refbox_main(int argc, char** argv) {
  return node_main(argc, argv, "refbox", [](NodeContext& context) {
    RefboxNode node{context, open_refbox(context.settings.refbox)};
    run(context, node.node());
  });
}

}  // namespace trivela::nodes
