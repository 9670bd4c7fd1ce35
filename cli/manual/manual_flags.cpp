#include "cli/manual/manual.hpp"

#include <fmt/core.h>

#include <string>

#include "nodes/runtime/node_flags.hpp"

namespace trivela::cli {
namespace {

std::string page_of_nodes() {
  CLI::App node{"Trivela's nodes", "trivela-NODE"};
  nodes::NodeFlags flags;
  nodes::add_node_flags(node, flags);
  return nodes_man_page(CLI::detail::split(TRIVELA_NODE_NAMES, ','), verb_tree(node));
}

}  // namespace

void add_manual_flags(CLI::App& app) {
  const auto man = [&app](const std::string& page) {
    fmt::print("{}", page == "nodes" ? page_of_nodes() : man_page(verb_tree(app)));
    throw CLI::Success{};
  };
  app.add_option_function<std::string>("--man", man, "The manual page of the verbs or of the nodes, for man -l -")
      ->check(CLI::IsMember{{"verbs", "nodes"}});
  const auto completion = [&app](const std::string& shell) {
    const auto make = shell == "bash" ? bash_completion : shell == "zsh" ? zsh_completion : fish_completion;
    fmt::print("{}", make(verb_tree(app)));
    throw CLI::Success{};
  };
  app.add_option_function<std::string>("--completion", completion, "What a shell completes: its script")
      ->check(CLI::IsMember{{"bash", "zsh", "fish"}});
}

}  // namespace trivela::cli
