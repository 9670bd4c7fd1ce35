#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "hal/refbox/refbox_client.hpp"
#include "nodes/runtime/node_context.hpp"
#include "nodes/runtime/simulated_device_notice.hpp"
#include "robot/referee/match_state.hpp"

namespace trivela::nodes {

/// The connection and what was said on it. It outlives a node that joins the bus again: the box would take a new
/// connection for a lost one, and the game would stop.
struct RefboxLink {
  std::unique_ptr<hal::refbox::RefboxClient> client;
  robot::MatchState match;
  bool emulated = false;  ///< the box said that it is a program
};

/// To the settings' referee box.
std::shared_ptr<RefboxLink> open_refbox(const config::Refbox& settings);

/// The referee box's commands in, `referee` out at each change and every period_s; the robots' beliefs out to the box
/// as often. A lost connection stops the game until a new START. In real time alone.
class RefboxNode {
 public:
  /// Throws std::runtime_error in lockstep, without the group that the box names us by, and beside another referee.
  RefboxNode(NodeContext& context, std::shared_ptr<RefboxLink> link);
  bus::Node& node() { return node_; }

 private:
  struct Tick {};
  using Event = std::variant<Tick, hal::refbox::BoxEvent>;

  std::optional<Event> next(std::chrono::nanoseconds timeout);
  void on_event(const Event& event);
  void on_box(const hal::refbox::Connected& event);
  void on_box(const hal::refbox::Command& command);
  void on_box(const hal::refbox::NoCommand& word);
  void on_box(const hal::refbox::Lost& lost);
  void on_box(const hal::refbox::Unreachable& failure);
  void on_world(const msg::WorldState& world);
  void on_tick();
  void publish();
  void tell_box();
  bool speaks_for(std::uint8_t robot_id) const;

  /// One of the robots that the node speaks for.
  struct Robot {
    std::uint8_t robot_id;
    bus::Output<msg::Referee> referee_out;
  };

  NodeContext& context_;
  std::shared_ptr<RefboxLink> link_;
  bus::Node node_;
  SimulatedDeviceNotice emulation_;
  std::vector<Robot> robots_;
  std::uint64_t seq_ = 0;
  std::chrono::steady_clock::time_point next_tick_{};
  std::chrono::steady_clock::time_point next_telling_{};
  std::mutex worlds_mutex_;  // beliefs come in the bus's thread
  std::array<std::optional<msg::WorldState>, 256> worlds_;
};

}  // namespace trivela::nodes
