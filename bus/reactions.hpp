#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace trivela::bus {

/// One edge set of the graph: what arrives, and which topics are written because of it.
struct Reaction {
  std::string name;                  // "node/topic" or "node/device"
  std::string input;                 // topic, or "device:..." or "timer:..." (which nobody writes)
  std::vector<std::string> outputs;  // topics
};

/// The topics of a cycle of reactions, first and last the same, if there is one: such a graph must not run to
/// completion in listeners, since a writer would wait for itself.
std::optional<std::vector<std::string>> find_cycle(std::span<const Reaction> reactions);

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
