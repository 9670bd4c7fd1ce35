#pragma once

#include <cstdint>
#include <optional>

#include "hal/refbox/command.hpp"
#include "idl/robot.hpp"

namespace trivela::robot {

/// The match as the referee box's commands have it; a pure function of them, of the connection and of the clock.
///
/// - START plays. STOP, the end of a part (HALF_TIME, END_GAME, END_PART, GAMEOVER), PARK, RESET and a lost connection
///   stop; nothing but a START plays again. The first word of a half (FIRST_HALF ..) neither stops nor plays.
/// - A set piece (KICKOFF .. DROP_BALL) is announced for the next START and changes nothing else. START, STOP, the end
/// of
///   a part and a lost connection take it back.
/// - A GOAL or SUBGOAL counts for its team; for none or both it counts for nobody.
/// - A RESET sets the match back when the connection ends after it: the box then begins again (RoboCup-MSL/RefBox,
///   mslrb2015/StateMachine.pde). Without that it stops the game alone: a box says it to all, too, when it turns
///   another client away (mslrb2015/Comms.pde). On a connection that was not accepted, by a WELCOME or another command,
///   it turns us away, and the match stays.
/// - Cards, repair, substitution, test mode, WELCOME and IS_ALIVE count as commands and change nothing.
class MatchState {
 public:
  /// A connection begins.
  void connected();
  /// It has ended, however.
  void disconnected();
  void command(const hal::refbox::Command& command, std::int64_t now_ns);

  bool playing() const { return playing_; }

  /// The state at now_ns, without robot_id and seq.
  msg::Referee message(std::int64_t now_ns) const;

 private:
  void stop();
  void start(std::int64_t now_ns);
  void end_part(hal::refbox::CommandKind word);
  void begin_half(msg::GameStage stage, std::uint8_t half, std::int64_t now_ns);
  void announce(msg::Restart restart, hal::refbox::Side side);
  void count_goal(hal::refbox::Side side, bool given);

  msg::GameStage stage_ = msg::STAGE_UNKNOWN;
  std::uint8_t half_ = 1;
  bool playing_ = false;
  msg::Restart restart_ = msg::RESTART_NONE;
  bool ours_ = false;
  std::uint16_t goals_own_ = 0;
  std::uint16_t goals_other_ = 0;
  std::uint32_t commands_ = 0;
  std::optional<std::int64_t> half_began_ns_;
  bool accepted_ = false;  // the box has said a word on this connection that is no RESET
  bool reset_ = false;     // its last word there was a RESET, and it had accepted us before
};

}  // namespace trivela::robot
