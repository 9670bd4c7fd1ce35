#include "cli/launch/node_program.hpp"

#include <unistd.h>

#include <cstdlib>
#include <set>
#include <sstream>

namespace trivela::cli {
namespace {

namespace fs = std::filesystem;

std::set<std::string, std::less<>>& played_by_this_program() {
  static std::set<std::string, std::less<>> nodes;
  return nodes;
}

}  // namespace

NodeProgram node_program(const std::string& node) {
  const fs::path self = fs::read_symlink("/proc/self/exe");
  if (played_by_this_program().contains(node)) return {self, {node}};
  const std::string name = "trivela-" + node;
  const fs::path beside = self.parent_path() / name;
  const char* const path = std::getenv("PATH");
  if (fs::exists(beside) || path == nullptr) return {beside, {}};
  std::istringstream folders{path};
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path found = fs::path{folder} / name;
    if (found.is_absolute() && access(found.c_str(), X_OK) == 0) return {found, {}};
  }
  return {beside, {}};
}

void play_by_this_program(std::string_view node) { played_by_this_program().emplace(node); }

}  // namespace trivela::cli
