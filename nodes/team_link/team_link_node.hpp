#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "nodes/runtime/node_context.hpp"
#include "nodes/team_link/team_member.hpp"
#include "robot/team/peer_table.hpp"
#include "robot/team/team_summary.hpp"

namespace trivela::nodes {

/// The one node of a machine that is on the team's bus too. Out goes `team_state`, and of the base its `referee`; in
/// come a robot's `referee`, where it is the base's, and `team_heard`, for the record and for who tells the referee
/// box. On its own machine's bus it looks on and is waited for by nobody.
class TeamLinkNode {
 public:
  /// Of `team_state`. The base's, by which all robots' clocks know its own, is the more frequent; of a robot's five
  /// ways each costs the air as much as the base's, and there are as many of these as robots.
  static constexpr std::chrono::milliseconds kBasePeriod{100};
  static constexpr std::chrono::milliseconds kRobotPeriod{200};

  /// Throws std::runtime_error beside another referee of the robot.
  TeamLinkNode(NodeContext& context, const bus::DomainConfig& team_bus);
  bus::Node& node() { return node_; }

 private:
  struct OfRobot {
    std::shared_ptr<bus::Mailbox<msg::WorldState>> world;
    std::shared_ptr<bus::Mailbox<msg::KickerStatus>> kicker;
    std::shared_ptr<bus::Mailbox<msg::KickDecision>> decision;
    std::shared_ptr<bus::Mailbox<msg::Referee>> referee;
    std::shared_ptr<bus::Mailbox<msg::VisionFrame>> vision;
    std::shared_ptr<bus::Mailbox<msg::DriveCommand>> drive;
  };

  void listen_to_robot();
  void listen_to_referee();
  void say_state();
  msg::TeamSummary summary();
  void receive(const TeamMember::ReceivedMessage& received);
  void receive(const msg::TeamState& state, std::int64_t t_ns);
  void receive(const msg::Referee& word, std::int64_t t_ns);
  void note_alarms(std::uint8_t other, std::uint32_t alarms);
  void report_duplicate();

  NodeContext& context_;
  const bool base_;
  const std::uint8_t own_;
  bus::Node node_;
  bus::Output<msg::TeamHeard> received_out_;
  std::optional<bus::Output<msg::Referee>> referee_out_;
  OfRobot robot_;
  std::mutex mutex_;  // of what follows
  robot::PeerTable peers_;
  robot::LatestSample<msg::Referee> referee_;  // of the base
  std::array<std::uint32_t, 256> alarms_{};
  std::int64_t duplicate_told_ns_ = 0;
  std::optional<TeamMember> member_;
};

/// The domain of the team's bus by the settings; with keys, as the identity that this machine has there.
/// Throws std::runtime_error naming the setting that is missing or wrong, bus::Error.
bus::DomainConfig team_domain(const config::Settings& settings, const std::string& keys);

}  // namespace trivela::nodes
