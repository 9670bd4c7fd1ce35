#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace trivela::cli {

/// What is started as a node.
struct NodeProgram {
  std::filesystem::path program;
  std::vector<std::string> arguments;  ///< before those of the node
};

/// Of the node, without "trivela-": the program beside this one, else the one on the PATH.
NodeProgram node_program(const std::string& node);

/// From now on the node is this program with the node's name as its first argument.
void play_by_this_program(std::string_view node);

}  // namespace trivela::cli
