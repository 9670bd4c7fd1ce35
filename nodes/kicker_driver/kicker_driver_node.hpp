#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "bus/writer.hpp"
#include "hal/kicker.hpp"
#include "nodes/kicker_driver/pending_kick.hpp"
#include "nodes/runtime/node_context.hpp"
#include "nodes/runtime/simulated_device_notice.hpp"
#include "robot/driver/kicker_controller.hpp"
#include "robot/watch/decision_watch.hpp"

namespace trivela::nodes {

/// Owns the kicker: device samples in, KickerStatus out; KickOrder in, KickReceipt out, and a fire to the device when
/// the KickerController accepts the order. An order may be fired up to a cycle after it was judged: the device has it
/// and waits; if the referee stops the game before that instant, or a sample tells of a fault or an open switch, the
/// kick is called off and a second receipt says so. Leaving, by whichever way, makes the device safe.
///
/// Two independent paths stop it: a referee that stops the game or falls silent, and a WorldState that does not play.
class KickerDriverNode {
 public:
  KickerDriverNode(NodeContext& context, std::unique_ptr<hal::Kicker> kicker);
  ~KickerDriverNode();
  KickerDriverNode(const KickerDriverNode&) = delete;
  KickerDriverNode& operator=(const KickerDriverNode&) = delete;

  bus::Node& node() { return node_; }

 private:
  void begin_in_real_time();
  void on_sample(const hal::KickerSample& sample);
  void on_order(const msg::KickOrder& order, robot::OrderBy by);
  void on_drive(const msg::DriveCommand& drive, const bus::SampleInfo& info);
  void receive_drive(const bus::SampleInfo& info);
  bool by_own_decision(const bus::SampleInfo& info);
  bool owns_decisions(const bus::SampleInfo& info) const;
  void on_referee(const msg::Referee& word, const bus::SampleInfo& info);
  void on_world(const msg::WorldState& world);
  void stop();
  void withdraw();
  void take_results();
  bool holds(std::int64_t judged_ns);
  void complete_predecessor();
  std::int64_t deadline_ns(const msg::KickOrder& order) const;
  std::int64_t now_t_ns() const;
  robot::RefereePermission referee_permission(const std::optional<msg::Referee>& word_of_cycle);
  void check_clock(const hal::KickerSample& sample);
  void say_link(bool lost);
  void demand_capabilities() const;
  void demand_lever() const;
  void demand_pulses() const;
  void tell_charge();
  void look_for_decision();
  void report_done(std::int64_t t_ns);

  NodeContext& context_;
  std::mutex mutex_;                    // device thread and order reaction
  std::optional<PendingKick> pending_;  // real time
  std::unique_ptr<hal::Kicker> kicker_;
  robot::KickerController controller_;
  std::int64_t sample_t_ns_ = 0;
  std::atomic<std::int64_t> called_off_ns_ = 0;  // the last stop, by the steady clock
  bool clock_differs_ = false;
  robot::DecisionNode decision_ = robot::DecisionNode::kUnheard;
  std::atomic<std::int64_t> decision_received_ns_ = 0;  // 0: not yet
  std::mutex drives_mutex_;
  std::map<std::string, bus::WriterWatch, std::less<>> drives_;  // by owner: the participants that write them
  bool other_orders_ = false;                                    // the last order was of another participant
  std::string link_said_;
  robot::LoopWatch loop_;
  std::vector<std::string> own_decisions_;  // owners of the writers whose orders count
  bus::Node node_;
  bus::Output<msg::KickerStatus> status_out_;
  bus::Output<msg::KickReceipt> receipt_out_;
  SimulatedDeviceNotice emulation_;
  std::optional<bus::Output<msg::StepDone>> step_done_;
  std::shared_ptr<bus::Mailbox<msg::Referee>> referee_of_cycle_;  // lockstep
  robot::RefereeWatch referee_;                                   // real time
  bool world_stands_ = false;                                     // the game, as the robot's own world has it
  FirstCycle first_;
};

}  // namespace trivela::nodes
