#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "idl/messages.hpp"
#include "robot/team/clock_exchange.hpp"

namespace trivela::robot {

/// Whom one participant of the team's bus knows there, and by how much their clocks are ahead of its own. Participants
/// by number, 0 the base. For one thread at a time.
class PeerTable {
 public:
  /// `started_ns`: this participant's own beginning, by its clock.
  PeerTable(std::uint8_t own, std::int64_t started_ns) : own_(own), started_ns_(started_ns) {}

  /// Takes in another's state. None: it is our own number's, or older than one that came.
  std::optional<msg::TeamHeard> received(const msg::TeamState& state, std::int64_t now_ns);

  /// Our own number, said by somebody who is not us: there are two.
  bool is_duplicate(const msg::TeamState& state) const {
    return state.robot_id == own_ && state.started_t_ns != started_ns_;
  }

  /// Number, instants and an echo to the one whose turn it is; the summary is the caller's.
  void fill(msg::TeamState& state, std::int64_t now_ns);

  /// None: not known, or nothing came from it recently.
  std::optional<OffsetEstimate> offset(std::uint8_t other, std::int64_t now_ns);

  /// The base's word as our robot hears it: by our number and clock, and never younger than it is. None: its clock is
  /// not known, or a later word came before it.
  std::optional<msg::Referee> own_referee(msg::Referee word, std::int64_t now_ns);

 private:
  struct Other {
    std::int64_t started_t_ns = 0;
    std::uint64_t seq = 0;
    ClockExchange clocks = {};
  };

  const std::uint8_t own_;
  const std::int64_t started_ns_;
  std::map<std::uint8_t, Other> others_;
  std::uint64_t seq_ = 0;
  std::uint64_t received_seq_ = 0;
  std::uint64_t referee_seq_ = 0;
  std::uint8_t last_echoed_ = 0;
  std::int64_t last_word_t_ns_ = 0;  // by the base's clock
  std::int64_t base_started_ns_ = 0;
};

}  // namespace trivela::robot
