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

}  // namespace trivela::bus
