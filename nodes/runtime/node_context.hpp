#pragma once

#include <spdlog/logger.h>

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "bus/node.hpp"
#include "bus/participant.hpp"
#include "bus/stop.hpp"
#include "config/robot.hpp"
#include "config/settings.hpp"

namespace trivela::nodes {

/// What every node is given: its settings, its robot, its place on the bus, its logger, and the word to stop.
struct NodeContext {
  config::Settings settings;
  config::Robot robot;
  bus::Participant participant;
  std::shared_ptr<spdlog::logger> logger;
  bus::Stop& stop;

  std::uint8_t robot_id() const { return static_cast<std::uint8_t>(settings.run.robot_id); }
  std::chrono::nanoseconds cycle() const;
};

/// Refuses to run beside another node of the same kind and robot: two of them would both write.
/// Throws std::runtime_error naming node, robot and topic.
template <class T>
void refuse_twin(const NodeContext& context, const bus::Output<T>& output, const std::string& node) {
  if (!output.other_writer_exists(std::chrono::milliseconds(300))) return;
  throw std::runtime_error{"another " + node + " of robot " + std::to_string(context.settings.run.robot_id) +
                           " writes " + std::string(bus::meta<T>::topic) + " in domain " +
                           std::to_string(context.settings.domain.domain_id) + ": stop it first"};
}

/// In lockstep nothing may be missed, so the first cycle waits until whoever reads an output has found it.
class FirstCycle {
 public:
  explicit FirstCycle(bool lockstep) : lockstep_(lockstep) {}

  /// In the first cycle of a lockstep run: waits until `output` has `n` readers; throws std::runtime_error when they do
  /// not come within 20 s.
  template <class T>
  void expect_readers(const bus::Output<T>& output, std::size_t n) const {
    if (!lockstep_ || done_ || output.wait_for_readers(n, std::chrono::seconds(20))) return;
    throw std::runtime_error{std::string(bus::meta<T>::topic) + " has " + std::to_string(output.readers()) + " of " +
                             std::to_string(n) + " readers after 20 s"};
  }
  void over() { done_ = true; }

 private:
  bool lockstep_;
  bool done_ = false;
};

/// How long a node waits for the other inputs of a cycle in lockstep before it gives up.
inline constexpr std::chrono::seconds kLockstepPatience{20};

/// The sample of cycle t_ns in lockstep, else the latest. Throws std::runtime_error when lockstep's never comes, unless
/// the node is being stopped.
template <class T>
std::optional<T> input_of_cycle(const NodeContext& context, bus::Mailbox<T>& mailbox, std::int64_t t_ns) {
  if (!context.settings.run.lockstep) return mailbox.latest();
  auto sample = mailbox.await(t_ns, kLockstepPatience);
  if (!sample && !context.stop.requested()) {
    throw std::runtime_error{"no " + std::string(bus::meta<T>::topic) + " of cycle " + std::to_string(t_ns) +
                             " ns after 20 s"};
  }
  return sample;
}

}  // namespace trivela::nodes
