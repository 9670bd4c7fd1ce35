#pragma once

#include <cstdint>
#include <optional>

#include "idl/messages.hpp"
#include "kicking/optional_double.hpp"

namespace trivela::robot {

/// The time that is left to take a set piece of ours. It runs from the START after the announcement of a restart that
/// is ours, and ends when the ball that was had since is lost (it was taken), the play is stopped, or no time is left.
class SetPieceClock {
 public:
  /// `limit_s`: to be taken within; 0: there is no such rule.
  explicit SetPieceClock(double limit_s) : limit_s_(limit_s) {}

  /// The referee's state, as often as it comes.
  void receive(const msg::Referee& word);

  /// At the belief's instant [s]; none: no set piece of ours is under way.
  kicking::OptionalDouble left_s(const msg::WorldState& world);

 private:
  double limit_s_;
  bool announced_ = false;
  std::optional<std::int64_t> began_t_ns_;
  bool had_ball_ = false;
};

}  // namespace trivela::robot
