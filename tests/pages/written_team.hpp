#pragma once

#include <chrono>
#include <cstdint>
#include <thread>

#include "bus/executor.hpp"
#include "bus/node.hpp"
#include "bus/stop.hpp"
#include "tests/pages/kicks_of_a_match.hpp"

namespace trivela::pages {

inline constexpr std::uint8_t kRobots = 5;
inline constexpr std::int64_t kKicks = 12;  // of each robot

/// A process with five robots' nodes, as far as the page knows them: each writes what it believes, decides and has, at
/// 50 Hz; a kick every tenth cycle, whose words come twice and out of order.
class WrittenTeam {
 public:
  explicit WrittenTeam(const bus::DomainConfig& domain)
      : participant_(domain),
        node_(participant_, "team"),
        world_(node_.writer<msg::WorldState>()),
        kicker_(node_.writer<msg::KickerStatus>()),
        referee_(node_.writer<msg::Referee>()),
        decision_(node_.writer<msg::KickDecision>()),
        receipt_(node_.writer<msg::KickReceipt>()),
        outcome_(node_.writer<msg::KickOutcome>()) {
    node_.every(
        std::chrono::milliseconds(20), "cycle", [this] { cycle(); },
        bus::writes<msg::WorldState, msg::KickerStatus, msg::Referee, msg::KickDecision, msg::KickReceipt,
                    msg::KickOutcome>());
    thread_ = std::thread([this] { bus::Executor{bus::Executor::kWaitset, stop_, {&node_}}.run(); });
  }
  ~WrittenTeam() {
    stop_.request();
    thread_.join();
  }
  const bus::Participant& participant() const { return participant_; }

 private:
  void cycle() {
    ++seq_;
    for (std::uint8_t robot = 1; robot <= kRobots; ++robot) {
      world_.write(world(robot, seq_, true, robot == 1));
      kicker_.write(kicker(robot, seq_));
      referee_.write(referee(robot, seq_));
      const auto kick = static_cast<std::int64_t>(seq_ / 10);
      const bool kicks = seq_ % 10 == 0 && kick <= kKicks;
      decision_.write(decision(robot, kicks ? kick : 0, robot < 4 ? msg::POLICY_STOPPED : msg::POLICY_MOVING, seq_));
      for (int again = 0; kicks && again < 2; ++again) {
        const bool inside = kick % 3 != 0;
        outcome_.write(outcome(robot, kick, inside ? msg::OUTCOME_ON_TARGET : msg::OUTCOME_OVER, ++words_));
        receipt_.write(receipt(robot, kick, true, ++words_));
      }
    }
  }

  bus::Participant participant_;
  bus::Node node_;
  bus::Output<msg::WorldState> world_;
  bus::Output<msg::KickerStatus> kicker_;
  bus::Output<msg::Referee> referee_;
  bus::Output<msg::KickDecision> decision_;
  bus::Output<msg::KickReceipt> receipt_;
  bus::Output<msg::KickOutcome> outcome_;
  std::uint64_t seq_ = 0, words_ = 0;
  bus::Stop stop_;
  std::thread thread_;
};

}  // namespace trivela::pages
