#include "bus/graph.hpp"

#include <algorithm>
#include <set>

namespace trivela::bus {
namespace {

// Depth first from a topic; the path is what led there.
bool closes_cycle(const std::string& topic, std::span<const Reaction> reactions, std::vector<std::string>& path,
                  std::set<std::string>& done) {
  if (const auto before = std::find(path.begin(), path.end(), topic); before != path.end()) {
    path.erase(path.begin(), before);
    path.push_back(topic);
    return true;
  }
  path.push_back(topic);
  if (!done.contains(topic)) {
    for (const Reaction& reaction : reactions) {
      if (reaction.input != topic) continue;
      for (const std::string& output : reaction.outputs)
        if (closes_cycle(output, reactions, path, done)) return true;
    }
    done.insert(topic);
  }
  path.pop_back();
  return false;
}

}  // namespace

std::optional<std::vector<std::string>> find_cycle(std::span<const Reaction> reactions) {
  std::set<std::string> done;
  for (const Reaction& reaction : reactions) {
    std::vector<std::string> path;
    if (closes_cycle(reaction.input, reactions, path, done)) return path;
  }
  return std::nullopt;
}

}  // namespace trivela::bus
