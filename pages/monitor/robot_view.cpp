#include "pages/monitor/robot_view.hpp"

#include <bit>
#include <type_traits>

namespace trivela::pages {

namespace {

constexpr std::int64_t kDecisionAge_ns = 300'000'000;  // one a cycle, with the ball

}  // namespace

const char* words_of(const msg::DecisionReason& reason) {
  switch (std::bit_cast<std::underlying_type_t<msg::DecisionReason>>(reason)) {  // of another program it may be any
    case msg::REASON_FIRE:
      return "every condition holds";
    case msg::REASON_NOT_PLAYING:
      return "the referee has stopped the game";
    case msg::REASON_NO_BALL:
      return "it does not have the ball";
    case msg::REASON_KICKER_NOT_READY:
      return "the kicker is not ready";
    case msg::REASON_ORDER_PENDING:
      return "an order of this possession is on its way";
    case msg::REASON_APPROACHING:
      return "it still drives or brakes";
    case msg::REASON_TURNING:
      return "it still turns to the target";
    case msg::REASON_SETTLING:
      return "it waits to be at rest";
    case msg::REASON_NOT_ALIGNED:
      return "the two segments do not meet";
    case msg::REASON_OUT_OF_RANGE:
      return "no set-point reaches the target";
    case msg::REASON_STALE_STATE:
      return "what it knows is too old";
    case msg::REASON_DRIVE_FINISHED:
      return "the test drive is through its list";
    case msg::REASON_UNLIKELY:
      return "a kick is too unlikely to be on target";
    case msg::REASON_WAITING:
      return "a later kick promises more";
    case msg::REASON_OWN_HALF:
      return "a goal from the own half would not count";
  }
  return "for a reason that this page does not know";
}

const msg::KickDecision* recent_fire(const RobotView& robot, std::int64_t now_ns) {
  const auto* fired = robot.fired.within(kFresh_ns, now_ns);
  if (fired == nullptr || !robot.decision.sample) return nullptr;
  const auto& last = *robot.decision.sample;
  return last.half == fired->half && last.possession_id == fired->possession_id ? fired : nullptr;
}

Why why_of(const RobotView& robot, std::int64_t now_ns) {
  if (recent_fire(robot, now_ns) != nullptr) return {true, words_of(msg::REASON_FIRE)};
  if (const auto* decision = robot.decision.within(kDecisionAge_ns, now_ns)) return {false, words_of(decision->reason)};
  const msg::WorldState* const world = robot.world.within(kFresh_ns, now_ns);
  if (world == nullptr) return {false, "no world_state is received"};
  if (!world->playing) return {false, words_of(msg::REASON_NOT_PLAYING)};
  if (!world->possession) return {false, words_of(msg::REASON_NO_BALL)};
  return {false, "it has the ball, and no decision is received"};
}

}  // namespace trivela::pages
