#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "idl/messages.hpp"
#include "kicking/geometry/goal.hpp"
#include "monitor/stream_statistics.hpp"
#include "pages/monitor/kick_ledger.hpp"

namespace trivela::pages {

/// The last sample of a topic and when it was heard.
template <class T>
struct Latest {
  std::optional<T> sample;
  std::int64_t received_ns = 0;

  void receive(const T& received, std::int64_t now_ns) {
    sample = received;
    received_ns = now_ns;
  }
  /// Where it is no older than `age_ns`.
  const T* within(std::int64_t age_ns, std::int64_t now_ns) const {
    return sample && now_ns - received_ns <= age_ns ? &*sample : nullptr;
  }
};

/// What was heard of a robot.
struct RobotView {
  Latest<msg::WorldState> world;
  Latest<msg::KickDecision> decision;
  Latest<msg::KickDecision> fired;  ///< the last one that did
  Latest<msg::KickerStatus> kicker;
  Latest<msg::DeviceKicker> device;
  Latest<msg::FlightFrame> flight;
  Latest<msg::KickerDrift> drift;
  Latest<msg::KickerEstimate> estimate;
  std::int64_t unarmed_since_ns = 0;  ///< the game is played and the kicker is off; 0: it is not so
};

/// What is kept of a robot as it came.
inline constexpr std::tuple kKeptOfRobots{&RobotView::world, &RobotView::kicker, &RobotView::flight, &RobotView::drift,
                                          &RobotView::estimate};

/// Whether it fires, and why or why not in words.
struct Why {
  bool fires = false;
  std::string words;
};

/// Older words say nothing of now.
inline constexpr std::int64_t kFresh_ns = 1'000'000'000;

/// The decision that fired, for a second, since an eye misses a cycle, or until it decides in another possession.
const msg::KickDecision* recent_fire(const RobotView& robot, std::int64_t now_ns);

/// Of its recent fire, else of its last decision, or where it decides nothing of what it believes.
Why why_of(const RobotView& robot, std::int64_t now_ns);

/// A reason as a part of a sentence: "the two segments do not meet".
const char* words_of(const msg::DecisionReason& reason);

/// Something that a person should look after.
struct Alarm {
  std::string text;
  std::int64_t since_ns = 0;
};

/// One that is mended.
struct MendedAlarm {
  std::string text;
  std::int64_t from_ns = 0;
  std::int64_t to_ns = 0;
};

/// Keeps since when each alarm holds, and the last ones that no longer do.
class ActiveAlarms {
 public:
  static constexpr std::size_t kMostMended = 5;

  /// `now`: the text of each alarm that holds at this moment, by a name that stays the same while it does.
  void update(const std::map<std::string, std::string>& now, std::int64_t now_ns);

  const std::map<std::string, Alarm>& alarms() const { return alarms_; }
  const std::deque<MendedAlarm>& mended() const { return mended_; }  ///< the newest first

 private:
  std::map<std::string, Alarm> alarms_;
  std::deque<MendedAlarm> mended_;
};

/// What a scene is told before anything is heard.
struct SceneSettings {
  std::string title;                            ///< the team's name
  std::map<std::uint8_t, std::string> names{};  ///< of robots, where they are known
  kicking::Goal goal{};
  double side_line_x_m = 6.0;
  double cycle_s = 0.02;
  GoalRules goal_rules{};
};

/// A topic as the page hears it, by its own clock alone, so that it holds in lockstep as well.
struct SceneStream {
  double period_s = 0.0;  ///< 0: it has none
  std::map<std::uint8_t, monitor::StreamStatistics> robots{};
};

/// All that the page knows.
struct SceneState {
  SceneSettings settings;
  std::map<std::uint8_t, RobotView> robots;
  Latest<msg::Referee> referee;
  KickLedger kicks;
  std::map<std::string, SceneStream> streams;  ///< by topic
  std::int64_t awake_ns = 0;                   ///< time that went on while somebody looked
  ActiveAlarms alarms;
  std::set<std::string> simulated;  ///< what says so; empty: nothing
  std::vector<std::string> nodes;   ///< programs that are there
  std::int64_t not_shown = 0;       ///< messages of robots that found no place
  bool over = false;                ///< nothing more comes, and that is as it should be

  explicit SceneState(SceneSettings given) : settings(std::move(given)), kicks(settings.goal_rules) {}
};

/// A match as it looks from the topics. Pure: messages and the clock are handed in, instants are of the listener's
/// clock. The simulator's truth is none of its inputs.
class MatchScene {
 public:
  static constexpr std::size_t kMostRobots = 16;  // anybody may say any number
  static constexpr std::int64_t kStep_ns = 100'000'000;

  explicit MatchScene(SceneSettings settings);

  /// What the page listens to: everything but the simulator's own.
  template <class T>
  static constexpr bool listens_to() {
    return !(std::is_same_v<T, msg::SimScan> || std::is_same_v<T, msg::StepDone> || std::is_same_v<T, msg::KickTruth> ||
             std::is_same_v<T, msg::PossessionTruth>);
  }

  template <bus::Message T>
  void receive(const T& sample, std::uint64_t writer, std::int64_t now_ns) {
    if (!has_place(sample.robot_id)) return;
    count(std::string{bus::meta<T>::topic}, sample.robot_id,
          {.writer = writer, .seq = sample.seq, .received_ns = awake_at(now_ns)});
    take(sample, now_ns);
  }

  /// Who is in the domain, and what of it says that this is no robot on a field.
  void note_members(std::vector<std::string> nodes, const std::set<std::string>& simulated);

  /// The match has ended as planned: silence is no alarm from here on, and no outcome is waited for.
  void note_over() { state_.over = true; }

  /// To be called each kStep_ns: what fell silent, which alarms hold. Where it comes later by far, it was this page
  /// that stood still: the time beyond two steps is nobody's silence.
  void look(std::int64_t now_ns);

  const SceneState& state() const { return state_; }

 private:
  bool has_place(std::uint8_t robot_id);
  std::int64_t awake_at(std::int64_t now_ns) const;
  void count(const std::string& topic, std::uint8_t robot_id, const monitor::ReceivedSample& received);

  /// Most are kept as they came, or are a sign of life alone.
  template <class T>
  void take(const T& sample, std::int64_t now_ns) {
    const auto keep = [&]<class Kept>(Kept RobotView::*kept) {
      if constexpr (std::is_same_v<Kept, Latest<T>>) (state_.robots[sample.robot_id].*kept).receive(sample, now_ns);
    };
    std::apply([&](auto... kept) { (keep(kept), ...); }, kKeptOfRobots);
  }
  void take(const msg::KickDecision& decision, std::int64_t now_ns);
  void take(const msg::KickReceipt& receipt, std::int64_t now_ns);
  void take(const msg::KickOutcome& outcome, std::int64_t now_ns);
  void take(const msg::DeviceKicker& device, std::int64_t now_ns);
  void take(const msg::DeviceWheels& device, std::int64_t now_ns);
  void take(const msg::DeviceGyro& device, std::int64_t now_ns);
  void take(const msg::DeviceEmulated& word, std::int64_t now_ns);
  void take(const msg::Referee& referee, std::int64_t now_ns);

  SceneState state_;
  std::optional<std::int64_t> looked_ns_;
};

/// Now, for the fates of kicks.
LedgerNow ledger_now(const SceneState& state, std::int64_t now_ns);

/// The alarms that hold: their texts by names that stay the same.
std::map<std::string, std::string> alarms_of(const SceneState& state, std::int64_t now_ns);

/// What moves, as JSON: `now_ms` by the listener's clock, `robots` with pose in F, segments, why each fires or holds,
/// its kicker, `ball`s as each believes, `flight` as a goal camera sees the last kick. null where there is no such
/// number; places in metres and radians.
std::string pitch_json(const SceneState& state, std::int64_t now_ns);

/// The rest: title, field, referee, the last kicks, the running table, alarms, whether it is simulated and by whose
/// word. Bytes that are no UTF-8 become U+FFFD. The same text while nothing changes.
std::string match_json(const SceneState& state, std::int64_t now_ns);

}  // namespace trivela::pages
