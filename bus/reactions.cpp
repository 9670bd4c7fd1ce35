#include "bus/reactions.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <set>
#include <utility>

#include "bus/domain/cyclone.hpp"

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

namespace {

thread_local const Reaction* t_reaction = nullptr;
thread_local bool t_in_listener = false;

}  // namespace

ReactionScope::ReactionScope(const Reaction& reaction, bool in_listener)
    : outer_(std::exchange(t_reaction, &reaction)),
      outer_in_listener_(std::exchange(t_in_listener, t_in_listener || in_listener)) {}

ReactionScope::~ReactionScope() {
  t_reaction = outer_;
  t_in_listener = outer_in_listener_;
}

const Reaction* ReactionScope::current() { return t_reaction; }
bool ReactionScope::in_listener() { return t_in_listener; }

void check_declared(const std::string& topic) {
  if (t_reaction == nullptr) return;
  const auto& outputs = t_reaction->outputs;
  if (std::find(outputs.begin(), outputs.end(), topic) == outputs.end())
    throw Error("write", topic, fmt::format("the reaction {} does not declare that it writes it", t_reaction->name));
}

}  // namespace trivela::bus
