#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "nodes/runtime/node_context.hpp"
#include "robot/watch/silence_watch.hpp"

namespace trivela::nodes {

/// Warns where an input of a node with a period falls silent and where it comes back, and where one has not been heard
/// some seconds after the start. Events have no period, and in lockstep silence has no meaning: nothing is watched.
class InputWatch {
 public:
  /// Gives the node a timer; all its inputs are declared by then. Both outlive the run.
  InputWatch(const NodeContext& context, bus::Node& node);
  InputWatch(const InputWatch&) = delete;
  InputWatch& operator=(const InputWatch&) = delete;

 private:
  struct Watched {
    std::string name;  // topic or device
    std::size_t stream = 0;
    std::int64_t period_ns = 0;
    std::vector<std::function<std::int64_t(std::int64_t)>> received_ns;  // a topic may come in several ways
    std::int64_t last_ns = 0;
  };

  void add(const bus::Input& input);
  void look(std::int64_t now_ns);
  void look_for_the_unheard(std::int64_t now_ns);

  const NodeContext& context_;
  std::vector<Watched> inputs_;
  robot::SilenceWatch watch_;
  robot::SilenceLines lines_;
  std::optional<std::int64_t> started_ns_, looked_ns_;
  bool silence_reported_ = false;
};

}  // namespace trivela::nodes
