#include "pages/monitor/match_scene.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <type_traits>
#include <utility>

namespace trivela::pages {

void ActiveAlarms::update(const std::map<std::string, std::string>& now, std::int64_t now_ns) {
  for (auto alarm = alarms_.begin(); alarm != alarms_.end();) {
    if (now.contains(alarm->first)) {
      ++alarm;
      continue;
    }
    mended_.push_front({alarm->second.text, alarm->second.since_ns, now_ns});
    if (mended_.size() > kMostMended) mended_.pop_back();
    alarm = alarms_.erase(alarm);
  }
  for (const auto& [name, text] : now) {
    Alarm& alarm = alarms_.try_emplace(name, Alarm{text, now_ns}).first->second;
    alarm.text = text;
  }
}

MatchScene::MatchScene(SceneSettings settings) : state_(std::move(settings)) {
  bus::for_each_message([this]<class T>() {
    if constexpr (listens_to<T>()) {
      const double period_s =
          bus::meta<T>::period_s > 0.0 ? std::max(bus::meta<T>::period_s, state_.settings.cycle_s) : 0.0;
      state_.streams[std::string{bus::meta<T>::topic}].period_s = period_s;
    }
  });
}

bool MatchScene::has_place(std::uint8_t robot_id) {
  if (robot_id != 0 && state_.robots.contains(robot_id)) return true;
  if (robot_id == 0 || state_.robots.size() >= kMostRobots) {
    ++state_.not_shown;
    return false;
  }
  state_.robots[robot_id];
  return true;
}

std::int64_t MatchScene::awake_at(std::int64_t now_ns) const {
  return state_.awake_ns + std::clamp<std::int64_t>(now_ns - looked_ns_.value_or(now_ns), 0, 2 * kStep_ns);
}

void MatchScene::count(const std::string& topic, std::uint8_t robot_id, const monitor::ReceivedSample& received) {
  SceneStream& stream = state_.streams.at(topic);
  stream.robots.try_emplace(robot_id, stream.period_s).first->second.see(robot_id, received);
}

void MatchScene::note_members(std::vector<std::string> nodes, const std::set<std::string>& simulated) {
  state_.nodes = std::move(nodes);
  state_.simulated.insert(simulated.begin(), simulated.end());
}

void MatchScene::look(std::int64_t now_ns) {
  state_.awake_ns = awake_at(now_ns);
  looked_ns_ = now_ns;
  for (auto& [id, robot] : state_.robots) {
    const auto* world = robot.world.within(kFresh_ns, now_ns);
    const auto* kicker = robot.kicker.within(kFresh_ns, now_ns);
    const bool unarmed = world != nullptr && kicker != nullptr && world->playing && !kicker->armed;
    if (!unarmed) robot.unarmed_since_ns = 0;
    if (unarmed && robot.unarmed_since_ns == 0) robot.unarmed_since_ns = now_ns;
  }
  state_.alarms.update(alarms_of(state_, now_ns), now_ns);
}

void MatchScene::take(const msg::KickDecision& decision, std::int64_t now_ns) {
  RobotView& robot = state_.robots[decision.robot_id];
  robot.decision.receive(decision, now_ns);
  if (decision.fire) robot.fired.receive(decision, now_ns);
  state_.kicks.receive(decision, now_ns);
}

void MatchScene::take(const msg::KickReceipt& receipt, std::int64_t now_ns) { state_.kicks.receive(receipt, now_ns); }

void MatchScene::take(const msg::KickOutcome& outcome, std::int64_t now_ns) { state_.kicks.receive(outcome, now_ns); }

void MatchScene::take(const msg::DeviceKicker& device, std::int64_t now_ns) {
  state_.robots[device.robot_id].device.receive(device, now_ns);
  if (device.emulated) state_.simulated.insert("an emulated kicker");
}

void MatchScene::take(const msg::DeviceWheels& device, std::int64_t) {
  if (device.emulated) state_.simulated.insert("an emulated base");
}

void MatchScene::take(const msg::DeviceGyro& device, std::int64_t) {
  if (device.emulated) state_.simulated.insert("an emulated gyro");
}

void MatchScene::take(const msg::DeviceEmulated& word, std::int64_t) {
  constexpr std::array kParts{"an emulated base", "an emulated gyro", "an emulated kicker", "an emulated referee box",
                              "an emulated range finder"};
  const auto part = static_cast<std::size_t>(word.part);
  state_.simulated.insert(part < kParts.size() ? kParts[part] : "an emulated device");
}

void MatchScene::take(const msg::Referee& referee, std::int64_t now_ns) { state_.referee.receive(referee, now_ns); }

LedgerNow ledger_now(const SceneState& state, std::int64_t now_ns) {
  LedgerNow now{.received_ns = now_ns, .over = state.over};
  for (const auto& [id, robot] : state.robots) {
    if (robot.world.sample) now.robots_t_ns[id] = robot.world.sample->t_ns;
  }
  return now;
}

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
