#include "pages/monitor/robot_view.hpp"

#include <array>
#include <bit>
#include <type_traits>

namespace trivela::pages {

namespace {

constexpr std::int64_t kDecisionAge_ns = 300'000'000;  // one a cycle, with the ball

/// In the order of msg::DecisionReason.
constexpr std::array kReasons{
    "every condition holds",
    "the referee has stopped the game",
    "it does not have the ball",
    "the kicker is not ready",
    "an order of this possession is on its way",
    "it still drives or brakes",
    "it still turns to the target",
    "it waits to be at rest",
    "the two segments do not meet",
    "no set-point reaches the target",
    "what it knows is too old",
    "the test drive is through its list",
    "a kick is too unlikely to be on target",
    "a later kick promises more",
    "a goal from the own half would not count",
};
static_assert(kReasons.size() == msg::REASON_OWN_HALF + 1);

}  // namespace

const char* words_of(const msg::DecisionReason& reason) {
  const auto number = std::bit_cast<std::underlying_type_t<msg::DecisionReason>>(reason);  // of another program any
  return number < kReasons.size() ? kReasons[number] : "for a reason that this page does not know";
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
