#include "bus/reaction_scope.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "bus/domain/cyclone.hpp"

namespace trivela::bus {
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
