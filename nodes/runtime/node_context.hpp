#pragma once

#include <spdlog/logger.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "bus/domain/participant.hpp"
#include "bus/node.hpp"
#include "bus/stop.hpp"
#include "bus/watchdog_hook.hpp"
#include "config/robot.hpp"
#include "config/settings.hpp"

namespace trivela::nodes {

class Supervisor;

/// A reading of a std::chrono clock in nanoseconds since that clock's epoch.
std::int64_t now_ns(auto clock_now) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(clock_now.time_since_epoch()).count();
}

/// What every node is given: its settings, its robot, its place on the bus, its logger, and the word to stop.
struct NodeContext {
  config::Settings settings;
  config::Robot robot;
  bus::Participant participant;
  std::shared_ptr<spdlog::logger> logger;
  bus::Stop& stop;
  /// This machine's steady clock, which every t_ns of real time is of [ns]; another one in tests.
  std::function<std::int64_t()> steady_ns = [] { return now_ns(std::chrono::steady_clock::now()); };
  /// Who started this process and waits for its signs of life; null: nobody.
  std::shared_ptr<Supervisor> supervisor = {};
  /// Folder of keys; empty: the bus is not secured.
  std::string keys = {};

  std::uint8_t robot_id() const { return static_cast<std::uint8_t>(settings.run.robot_id); }
  std::chrono::nanoseconds cycle() const;

  /// A sign of life, for nodes with a loop of their own, each time it comes round.
  void alive() const;

  /// The same for an executor, which gives it while all of its node's loops come round: what is late is an error in the
  /// log, and no sign of life is given. The context outlives it.
  bus::WatchdogHook watchdog_hook() const;

  /// Waits for the stop, no longer than the timeout.
  void idle(std::chrono::nanoseconds timeout) const;
};

/// Refuses to run beside another node of the same kind and robot: two of them would both write. The elder of two that
/// begin together stays.
/// Throws std::runtime_error naming node, robot and topic.
template <class T>
void reject_duplicate_node(const NodeContext& context, const bus::Output<T>& output, const std::string& node,
                           std::optional<std::uint32_t> robot_id = {}) {
  if (!output.elder_writer_exists()) return;
  throw std::runtime_error{"another " + node + " of robot " +
                           std::to_string(robot_id.value_or(context.settings.run.robot_id)) + " writes " +
                           std::string(bus::meta<T>::topic) + " in domain " +
                           std::to_string(context.settings.domain.domain_id) + ": stop it first"};
}

/// Who writes `referee` for a robot: nodes of several kinds do, and there must be one of them.
inline bus::WriterOptions referee_of(std::uint32_t robot_id) {
  bus::WriterOptions options;
  options.owner = "referee/" + std::to_string(robot_id);
  return options;
}

/// The names of a robot's decision nodes on the bus: its only or first one, and the one that stands by.
inline constexpr const char* kDecisionNode = "kick_decision";
inline constexpr const char* kSecondDecisionNode = "kick_decision_second";

/// How long a node waits in lockstep for the others before it gives up.
inline constexpr std::chrono::seconds kLockstepTimeout{20};

/// Asks `ready(timeout)` again and again until it says so. False: the stop was requested first. Throws
/// std::runtime_error with `what` when the timeout is over.
[[nodiscard]] bool ready_before_stop(const bus::Stop& stop, auto&& ready, const std::string& what) {
  constexpr std::chrono::milliseconds kPollInterval{100};  // how often the stop is looked for
  const auto deadline = std::chrono::steady_clock::now() + kLockstepTimeout;
  while (!ready(kPollInterval)) {
    if (stop.requested()) return false;
    if (std::chrono::steady_clock::now() > deadline) throw std::runtime_error{what + " after 20 s"};
  }
  return true;
}

/// In lockstep nothing may be missed, so the first cycle waits for whoever reads the outputs and for the device.
class FirstCycle {
 public:
  explicit FirstCycle(bool lockstep) : pending_(lockstep) {}

  /// Runs `expectations` in the first cycle of a lockstep run, once.
  void once(auto&& expectations) {
    if (pending_) expectations();
    pending_ = false;
  }

 private:
  bool pending_;
};

/// Waits until a device's other side is there; throws std::runtime_error when it does not come.
void expect_device(auto& device) {
  if (!device.connected(kLockstepTimeout)) throw std::runtime_error{"the device has not answered within 20 s"};
}

/// The sample of cycle t_ns in lockstep, else the latest. Throws std::runtime_error when lockstep's never comes, unless
/// the node is being stopped.
template <class T>
std::optional<T> input_of_cycle(const NodeContext& context, bus::Mailbox<T>& mailbox, std::int64_t t_ns) {
  if (!context.settings.run.lockstep) return mailbox.latest();
  auto sample = mailbox.await(t_ns, kLockstepTimeout);
  if (!sample && !context.stop.requested()) {
    throw std::runtime_error{"no " + std::string(bus::meta<T>::topic) + " of cycle " + std::to_string(t_ns) +
                             " ns after 20 s"};
  }
  return sample;
}

}  // namespace trivela::nodes
