#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include <trivela/program.hpp>
#include "cli/launch/child_process.hpp"
#include "cli/program.hpp"

namespace trivela::nodes {
int kick_decision_main(int argc, char** argv);
int kick_decision_second_main(int argc, char** argv);
int chain_main(int argc, char** argv);
}  // namespace trivela::nodes

namespace trivela {
namespace {

using Main = int (*)(int, char**);
constexpr std::array kNodes{std::pair<std::string_view, Main>{"kick_decision", nodes::kick_decision_main},
                            std::pair<std::string_view, Main>{"kick_decision_second", nodes::kick_decision_second_main},
                            std::pair<std::string_view, Main>{"chain", nodes::chain_main}};

}  // namespace

int run(int argc, char** argv) {
  for (const auto& [name, main] : kNodes) {
    if (argc < 2 || name != argv[1]) continue;
    std::vector<char*> rest{argv[0]};
    rest.insert(rest.end(), argv + 2, argv + argc);
    rest.push_back(nullptr);
    return main(argc - 1, rest.data());
  }
  for (const auto& node : kNodes) cli::play_by_this_program(node.first);
  return cli::run_verbs(argc, argv);
}

int run_decision_node(int argc, char** argv) { return nodes::kick_decision_main(argc, argv); }

int run_simulate(int argc, char** argv) {
  static char simulate[] = "simulate";
  std::vector<char*> all{argv[0], simulate};
  all.insert(all.end(), argv + 1, argv + argc);
  all.push_back(nullptr);
  return cli::run_verbs(argc + 1, all.data());
}

}  // namespace trivela
