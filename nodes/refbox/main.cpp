#include "nodes/refbox/refbox_node.hpp"
#include "nodes/runtime/node_main.hpp"

namespace trivela::nodes {

int refbox_main(int argc, char** argv) {
  std::shared_ptr<RefboxLink> link;  // one connection, also where the node joins the bus anew
  return node_main(argc, argv, "refbox", [&link](NodeContext& context) {
    if (!link) link = open_refbox(context.settings.refbox);
    RefboxNode node{context, link};
    run(context, node.node());
  });
}

}  // namespace trivela::nodes
