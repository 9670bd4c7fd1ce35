#include "robot/referee/match_state.hpp"

#include <limits>

#include "idl/messages.hpp"
#include "kicking/geometry/time.hpp"

namespace trivela::robot {

using hal::refbox::CommandKind;
using hal::refbox::Side;

namespace {

/// The stage that follows a part which has ended by this word.
msg::GameStage stage_after(msg::GameStage stage, CommandKind word) {
  if (word == CommandKind::kGameOver) return msg::STAGE_GAME_OVER;
  switch (stage) {
    case msg::STAGE_FIRST_HALF:
      return msg::STAGE_HALF_TIME;
    case msg::STAGE_SECOND_HALF:
      return msg::STAGE_FULL_TIME;
    case msg::STAGE_FIRST_OVERTIME:
      return msg::STAGE_OVERTIME_BREAK;
    case msg::STAGE_SECOND_OVERTIME:
      return msg::STAGE_PENALTIES;
    case msg::STAGE_UNKNOWN:  // who joined during the match knows by the word alone, if at all
      return word == CommandKind::kEndGame ? msg::STAGE_FULL_TIME : msg::STAGE_UNKNOWN;
    default:
      return stage;
  }
}

std::optional<msg::Restart> restart_of(CommandKind kind) {
  switch (kind) {
    case CommandKind::kKickOff:
      return msg::RESTART_KICKOFF;
    case CommandKind::kFreeKick:
      return msg::RESTART_FREEKICK;
    case CommandKind::kGoalKick:
      return msg::RESTART_GOALKICK;
    case CommandKind::kThrowIn:
      return msg::RESTART_THROWIN;
    case CommandKind::kCorner:
      return msg::RESTART_CORNER;
    case CommandKind::kPenalty:
      return msg::RESTART_PENALTY;
    case CommandKind::kDropBall:
      return msg::RESTART_DROP_BALL;
    default:
      return std::nullopt;
  }
}

}  // namespace

void MatchState::connected() { accepted_ = reset_ = false; }

void MatchState::disconnected() {
  stop();
  if (reset_) {
    const std::uint32_t commands = commands_;
    *this = {};
    commands_ = commands;
    stage_ = msg::STAGE_PRE_GAME;
  }
  accepted_ = reset_ = false;
}

void MatchState::stop() {
  playing_ = false;
  announce(msg::RESTART_NONE, Side::kBoth);
}

void MatchState::start(std::int64_t now_ns) {
  playing_ = true;
  announce(msg::RESTART_NONE, Side::kBoth);
  if (!half_began_ns_) half_began_ns_ = now_ns;
}

void MatchState::end_part(CommandKind word) {
  stop();
  stage_ = stage_after(stage_, word);
  half_began_ns_.reset();
}

void MatchState::begin_half(msg::GameStage stage, std::uint8_t half, std::int64_t now_ns) {
  if (stage_ == stage) return;
  stage_ = stage;
  half_ = half;
  half_began_ns_.reset();
  if (playing_) half_began_ns_ = now_ns;  // its START came first
}

void MatchState::announce(msg::Restart restart, Side side) {
  restart_ = restart;
  ours_ = side == Side::kOurs;
}

void MatchState::count_goal(Side side, bool given) {
  if (side == Side::kBoth) return;
  std::uint16_t& goals = side == Side::kOurs ? goals_own_ : goals_other_;
  if (given && goals < std::numeric_limits<std::uint16_t>::max()) ++goals;
  if (!given && goals > 0) --goals;
}

void MatchState::command(const hal::refbox::Command& command, std::int64_t now_ns) {
  ++commands_;
  reset_ = command.kind == CommandKind::kReset && accepted_;
  accepted_ = accepted_ || command.kind != CommandKind::kReset;
  switch (command.kind) {
    case CommandKind::kStart:
      return start(now_ns);
    case CommandKind::kStop:
    case CommandKind::kReset:
    case CommandKind::kPark:
      return stop();
    case CommandKind::kFirstHalf:
      return begin_half(msg::STAGE_FIRST_HALF, 1, now_ns);
    case CommandKind::kSecondHalf:
      return begin_half(msg::STAGE_SECOND_HALF, 2, now_ns);
    case CommandKind::kFirstHalfOvertime:
      return begin_half(msg::STAGE_FIRST_OVERTIME, 3, now_ns);
    case CommandKind::kSecondHalfOvertime:
      return begin_half(msg::STAGE_SECOND_OVERTIME, 4, now_ns);
    case CommandKind::kHalfTime:
    case CommandKind::kEndGame:
    case CommandKind::kEndPart:
    case CommandKind::kGameOver:
      return end_part(command.kind);
    case CommandKind::kGoal:
    case CommandKind::kSubGoal:
      return count_goal(command.side, command.kind == CommandKind::kGoal);
    default:
      if (const auto restart = restart_of(command.kind)) announce(*restart, command.side);
  }
}

msg::Referee MatchState::message(std::int64_t now_ns) const {
  msg::Referee word{};
  word.t_ns = now_ns;
  word.half = half_;
  word.playing = playing_;
  word.stage = stage_;
  word.restart = restart_;
  word.ours = ours_;
  word.goals_own = goals_own_;
  word.goals_other = goals_other_;
  word.command_counter = commands_;
  word.half_time_s = half_began_ns_ ? kicking::seconds(now_ns - *half_began_ns_) : msg::kNone;
  return word;
}

}  // namespace trivela::robot
