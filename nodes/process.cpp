// What each node's process begins with; TRIVELA_NODE_MAIN stands at the end of the node's own source.
namespace trivela::nodes {
int TRIVELA_NODE_MAIN(int argc, char** argv);  // NOLINT(readability-identifier-naming): a macro's name
}

int main(int argc, char** argv) { return trivela::nodes::TRIVELA_NODE_MAIN(argc, argv); }
