#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <type_traits>

#include "evaluator/drift/drift_watch.hpp"
#include "pages/monitor/match_scene.hpp"
#include "robot/watch/silence_watch.hpp"

namespace trivela::pages {
namespace {

using Alarms = std::map<std::string, std::string>;

constexpr double kShortestSilence_s = 0.5;         // a page is for eyes, and a machine may be busy
constexpr std::int64_t kUnarmed_ns = 500'000'000;  // the driver arms a cycle after the referee's word
constexpr std::size_t kLastKicks = 10;
constexpr int kMostUnknown = 2;  // of them

void note_silences(std::uint8_t id, const std::vector<std::string>& silent, bool all, Alarms& alarms) {
  if (all) {
    alarms[fmt::format("{}/silent", id)] = fmt::format("robot {} is silent", id);
    return;
  }
  for (const std::string& topic : silent) {
    alarms[fmt::format("{}/silent/{}", id, topic)] =
        topic == bus::meta<msg::Referee>::topic ? fmt::format("robot {}: the referee is silent", id)
                                                : fmt::format("robot {}: no {} is received any more", id, topic);
  }
}

void note_streams(const SceneState& state, std::uint8_t id, Alarms& alarms) {
  std::vector<std::string> silent;
  std::size_t periodic = 0;
  for (const auto& [topic, stream] : state.streams) {
    const auto received = stream.robots.find(id);
    if (received == stream.robots.end()) continue;
    const monitor::StreamFigures figures = received->second.figures(state.awake_ns);
    if (figures.lost_lately > 0) {
      const std::string how_many =
          figures.lost_lately == 1 ? "a message" : fmt::format("{} messages", figures.lost_lately);
      alarms[fmt::format("{}/missed/{}", id, topic)] =
          fmt::format("robot {}: this page missed {} of {}", id, how_many, topic);
    }
    if (stream.period_s <= 0.0) continue;
    ++periodic;
    if (figures.silent_for_s > std::max(robot::kSilentPeriods * stream.period_s, kShortestSilence_s))
      silent.push_back(topic);
  }
  if (!state.over) note_silences(id, silent, periodic > 0 && silent.size() == periodic, alarms);
}

const char* words_of(msg::KickerFault fault) {
  switch (fault) {
    case msg::FAULT_NONE:
      return "fault";
    case msg::FAULT_CHARGER:
      return "fault of the charger";
    case msg::FAULT_COIL:
      return "fault of the coil";
    case msg::FAULT_LINK:
      return "its board does not answer";
  }
  return "a fault that this page does not know";
}

void note_kickers(const SceneState& state, std::int64_t now_ns, Alarms& alarms) {
  for (const auto& [id, robot] : state.robots) {
    const auto* kicker = robot.kicker.within(kFresh_ns, now_ns);
    if (kicker != nullptr && (kicker->fault != msg::FAULT_NONE || kicker->state == msg::STATE_FAULT))
      alarms[fmt::format("{}/fault", id)] = fmt::format("robot {}: kicker: {}", id, words_of(kicker->fault));
    const auto* device = robot.device.within(kFresh_ns, now_ns);
    const bool open = device != nullptr ? !device->armed
                                        : robot.unarmed_since_ns != 0 && now_ns - robot.unarmed_since_ns >= kUnarmed_ns;
    if (open && !state.over) alarms[fmt::format("{}/switch", id)] = fmt::format("robot {}: the arm switch is open", id);
  }
}

// The change as `trivela drift` words it; what has no size comes from another program.
std::string words_of(const msg::KickerDrift& said) {
  const auto kind = std::bit_cast<std::underlying_type_t<msg::DriftKind>>(said.kind);
  evaluator::Drift drift{
      .kind = kind == msg::DRIFT_ELEVATION ? evaluator::DriftKind::kElevation : evaluator::DriftKind::kExitSpeed,
      .factor = {std::log(said.factor), said.factor_se},
      .height_m = said.height_m};
  const bool sized = said.factor > 0.0 && std::isfinite(drift.factor.value) && drift.factor.value != 0.0;
  if (!sized) return "by how much is not said";
  return fmt::format("{}; {}", evaluator::words_of(drift), evaluator::correction_of(drift));
}

void note_drifts(const SceneState& state, Alarms& alarms) {
  for (const auto& [id, robot] : state.robots) {
    const auto& said = robot.drift.sample;
    if (!said || said->changes == 0) continue;
    alarms[fmt::format("{}/drift", id)] =
        fmt::format("robot {}: its kicker changed at kick {}: {}", id, said->changed_kick_id, words_of(*said));
  }
}

void note_kicks(const SceneState& state, std::int64_t now_ns, Alarms& alarms) {
  const LedgerNow now = ledger_now(state, now_ns);
  const auto last = state.kicks.latest(kLastKicks);
  const auto unknown =
      std::ranges::count_if(last, [&](const KnownKick& kick) { return fate_of(kick, now) == KickFate::kUnknown; });
  if (unknown > kMostUnknown)
    alarms["unknown"] = fmt::format("{} of the last {} kicks have no known outcome", unknown, last.size());
  if (state.kicks.not_kept() > 0)
    alarms["full"] = fmt::format("the table is full: kicks beyond {} are not counted", KickLedger::kMostKicks);
}

}  // namespace

Alarms alarms_of(const SceneState& state, std::int64_t now_ns) {
  Alarms alarms;
  for (const auto& [id, robot] : state.robots) note_streams(state, id, alarms);
  const bool refereed = !state.streams.at(std::string{bus::meta<msg::Referee>::topic}).robots.empty();
  if (!state.over && !state.robots.empty() && !refereed) alarms["referee"] = "no referee has been received";
  note_kickers(state, now_ns, alarms);
  note_drifts(state, alarms);
  note_kicks(state, now_ns, alarms);
  if (state.not_shown > 0)
    alarms["not_shown"] =
        fmt::format("messages of more than {} robots, or of robot 0: not shown", MatchScene::kMostRobots);
  return alarms;
}

}  // namespace trivela::pages
