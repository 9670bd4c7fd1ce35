#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tests/faults/hub.hpp"
#include "tests/faults/line_pipe.hpp"
#include "tests/faults/network_host.hpp"
#include "tests/faults/node_process.hpp"
#include "tests/faults/schedule.hpp"
#include "tests/faults/testimony.hpp"

namespace trivela::faults {

struct StackPlan {
  std::filesystem::path programs;  ///< folder of trivela-NODE
  std::filesystem::path own;       ///< folder of fault_witness, fault_referee and fault_client
  std::filesystem::path folder;    ///< for configuration, logs and what the nodes say; exists
  bool with_links = true;          ///< a host for each node; otherwise all share the loopback, and there is no referee
  std::uint64_t seed = 1;
};

/// The nodes of one robot with its simulator, each a process on a host of its own, and two witnesses: one on the
/// driver's host, one on a host that no fault touches.
class Stack {
 public:
  explicit Stack(const StackPlan& plan);
  Stack(const Stack&) = delete;
  Stack& operator=(const Stack&) = delete;

  void start(std::size_t node);
  void start_all();
  /// SIGTERM to every node, the recorder last, and waits for them.
  void stop_all();

  NodeProcess& node(std::size_t node) { return *nodes_[node]; }
  bool running(std::size_t node) { return nodes_[node] && !nodes_[node]->ended(); }

  /// Whether the node is one of this stack.
  bool has(std::size_t node) const { return plan_.with_links || kNodes[node] != "referee"; }

  /// A second one of the kind, on the same host.
  std::unique_ptr<NodeProcess> twin(std::size_t node);

  /// Whether fault_client orders on kick_decision's host.
  void insist(Insists who);

  /// What the links of a fault do from now on; all are sound again with sound().
  void disturb(const Fault& fault);
  void sound();
  HubCounts hub_counts() const { return hub_ ? hub_->counts() : HubCounts{}; }

  /// Frames that reached the driver's host with bits turned over.
  std::vector<GarbledFrame> garbled_to_driver() const;

  /// Takes in what the witnesses say, for up to `timeout` or until `done` says so, which is asked after each word and
  /// at least every 20 ms. Throws std::runtime_error if a witness is gone.
  bool listen(std::chrono::nanoseconds timeout, const std::function<bool()>& done);

  /// A new witness on the driver's host goes on with the testimony.
  void renew_device_witness();

  const Testimony& device() const { return device_.testimony; }
  const Testimony& wire() const { return wire_.testimony; }

  /// Match logs so far.
  std::vector<std::filesystem::path> logs() const;

  /// Last change of any log, by the system's clock; none: there is no log.
  std::optional<std::filesystem::file_time_type> log_changed() const;

 private:
  struct Witness {
    Testimony testimony;
    std::unique_ptr<LinePipe> words;
    std::unique_ptr<NodeProcess> process;
  };

  int network(std::size_t host) const;
  void write_configuration() const;
  ProcessPlan plan_of(std::size_t node);
  void start_witness(Witness& witness, const char* name, int network);
  void start_referee();
  void receive(Witness& witness);
  void hear_referee();

  StackPlan plan_;
  std::vector<NetworkHost> hosts_;  // of the nodes, then of the wire's witness
  std::unique_ptr<Hub> hub_;
  std::vector<std::unique_ptr<NodeProcess>> nodes_{kNodes.size()};
  std::size_t simulators_ = 0;
  Witness device_;
  Witness wire_;
  std::unique_ptr<LinePipe> referee_words_;
  std::unique_ptr<NodeProcess> client_;
};

}  // namespace trivela::faults
