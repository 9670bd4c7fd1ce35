#pragma once

#include "bus/graph.hpp"

namespace trivela::bus {

/// Marks the current thread as running a reaction while it lives; they nest where a write runs listeners.
class ReactionScope {
 public:
  /// in_listener: the thread is a writer's or Cyclone's receive thread, so that it must not wait for samples.
  ReactionScope(const Reaction& reaction, bool in_listener);
  ReactionScope(const ReactionScope&) = delete;
  ReactionScope& operator=(const ReactionScope&) = delete;
  ~ReactionScope();

  /// The innermost reaction of this thread, or nullptr.
  static const Reaction* current();

  /// Whether this thread runs a listener.
  static bool in_listener();

 private:
  const Reaction* outer_;
  bool outer_in_listener_;
};

/// Throws Error if this thread runs a reaction that did not declare that it writes the topic.
void check_declared(const std::string& topic);

}  // namespace trivela::bus
