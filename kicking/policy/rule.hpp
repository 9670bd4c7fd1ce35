#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <tuple>

#include "kicking/alignment/alignment.hpp"
#include "kicking/alignment/release_predictor.hpp"
#include "kicking/geometry/frames.hpp"
#include "kicking/geometry/goal.hpp"
#include "kicking/model/robot_model.hpp"
#include "kicking/optional_double.hpp"
#include "kicking/outcome/opponents.hpp"
#include "kicking/policy/policy_config.hpp"

namespace trivela::kicking {

/// Why a policy fires or holds.
enum class Reason {
  kFire,
  kNotPlaying,
  kNoBall,
  kKickerNotReady,
  kOrderPending,
  kApproaching,
  kTurning,
  kSettling,
  kNotAligned,
  kOutOfRange,
  kStaleState,
  kDriveFinished,
  kUnlikely,
  kWaiting,
  kOwnHalf
};

/// Their names in logs and reports, in their order.
inline constexpr std::array kReasonNames{"fire",          "not_playing",  "no_ball",     "kicker_not_ready",
                                         "order_pending", "approaching",  "turning",     "settling",
                                         "not_aligned",   "out_of_range", "stale_state", "drive_finished",
                                         "unlikely",      "waiting",      "own_half"};
constexpr const char* name(Reason reason) { return kReasonNames.at(static_cast<std::size_t>(reason)); }

/// What was seen of a kick.
struct SeenKick {
  std::int64_t kick_id = 0;
  std::uint32_t possession_id = 0;  ///< that it ended
  OptionalDouble x_cross_m;         ///< ball centre at the goal line, in F; none: it was not seen to cross
};

/// What one cycle knows.
struct PolicyInput {
  std::int64_t t_ns = 0;  ///< instant at which pose and twist hold
  Pose pose{};            ///< in F
  Twist twist{};          ///< in R
  bool playing = false;
  bool possession = false;
  std::uint32_t possession_id = 0;
  bool kicker_ready = false;
  double state_age_s = 0.0;    ///< of the older of world state and kicker status
  double sd_position_m = 0.0;  ///< of the pose by its filter, each axis
  double sd_heading_rad = 0.0;
  std::uint8_t lever_kind = 0;         ///< kind of kick that the lever stands for; kLeverMoves: for none
  OptionalDouble opponent_distance_m;  ///< nearest opponent to the ball; stopped and moving do not look at it
  std::array<BodyPlace, kMostBodies> opponents{};  ///< that are tracked, the keeper aside
  std::size_t opponent_count = 0;                  ///< of them; 0: their places are not known
  OptionalDouble opponent_closing_mps;  ///< how fast it comes, where both are known exactly: the oracle alone
  std::optional<KeeperPlace> keeper;    ///< that is tracked
  std::optional<SeenKick> last_kick;    ///< the latest one with an outcome; the turn drive alone looks at it
  OptionalDouble set_piece_left_s;      ///< a kick that takes our set piece is released until then
};

/// What the kick of one cycle needs, and where it would go.
struct ShotNumbers {
  double distance_m = 0.0;    ///< ball centre to target, horizontal
  OptionalDouble v0_mps;      ///< exit speed for a robot at rest; none: the angle is too flat for the height
  OptionalDouble v_kick_mps;  ///< exit speed asked of the kicker
  OptionalDouble power;       ///< set-point, fractional
  std::optional<PredictedCrossing> predicted;  ///< where that set-point sends the ball, if the order goes out now
};

/// One decision with every number behind it.
struct PolicyOutput : Alignment, ShotNumbers {
  bool fire = false;
  Reason reason = Reason::kNotPlaying;
  double target_x_m = 0.0;  ///< aim point in F
  double target_y_m = 0.0;
  double target_z_m = 0.0;
  double alpha_rad = 0.0;       ///< right positive
  double beta_rad = 0.0;        ///< with the sign of omega
  OptionalDouble p_on_target;   ///< predicted probability that this kick is on target; none: not computed
  OptionalDouble p_goal;        ///< the same, and past the keeper; none: no keeper is tracked
  double fire_after_s = 0.0;    ///< energise the coil so much later than the input's instant, within a cycle
  std::uint8_t kick_kind = 0;   ///< of the kick, as in RobotModel::kind()
  std::uint8_t lever_kind = 0;  ///< for which the lever shall stand until the next cycle
  Twist drive{};                ///< command until the next cycle, in R

  Alignment& alignment() { return *this; }
  ShotNumbers& shot() { return *this; }
};

/// A number of the predicted crossing.
template <double PredictedCrossing::*number>
OptionalDouble predicted(const PolicyOutput& output) {
  return output.predicted ? OptionalDouble((*output.predicted).*number) : std::nullopt;
}

/// A part of an output that is recorded, by its name in the messages. A new field of PolicyOutput stands below, too.
template <class Get>
struct RecordedField {
  std::string_view name;
  Get get;  ///< for std::invoke, with an output
};
template <class Get>
RecordedField(std::string_view, Get) -> RecordedField<Get>;

inline constexpr std::tuple kRecordedFields{
    RecordedField{"fire", &PolicyOutput::fire},
    RecordedField{"reason", &PolicyOutput::reason},
    RecordedField{"target_x_m", &PolicyOutput::target_x_m},
    RecordedField{"target_y_m", &PolicyOutput::target_y_m},
    RecordedField{"target_z_m", &PolicyOutput::target_z_m},
    RecordedField{"distance_m", &PolicyOutput::distance_m},
    RecordedField{"v0_mps", &PolicyOutput::v0_mps},
    RecordedField{"v_kick_mps", &PolicyOutput::v_kick_mps},
    RecordedField{"power", &PolicyOutput::power},
    RecordedField{"alpha_rad", &PolicyOutput::alpha_rad},
    RecordedField{"beta_rad", &PolicyOutput::beta_rad},
    RecordedField{"aligned", &PolicyOutput::aligned},
    RecordedField{"offset_right_m", &PolicyOutput::offset_right_m},
    RecordedField{"left_m", &PolicyOutput::left_m},
    RecordedField{"right_m", &PolicyOutput::right_m},
    RecordedField{"predicted_x_cross_m", predicted<&PredictedCrossing::x_m>},
    RecordedField{"predicted_z_cross_m", predicted<&PredictedCrossing::z_m>},
    RecordedField{"predicted_t_flight_s", predicted<&PredictedCrossing::t_flight_s>},
    RecordedField{"p_on_target", &PolicyOutput::p_on_target},
    RecordedField{"p_goal", &PolicyOutput::p_goal},
    RecordedField{"fire_after_s", &PolicyOutput::fire_after_s},
    RecordedField{"kick_kind", &PolicyOutput::kick_kind},
    RecordedField{"lever_kind", &PolicyOutput::lever_kind}};

/// What every policy remembers of a possession. One that remembers more derives from it.
struct PossessionMemory {
  std::optional<std::uint32_t> possession_id;
  std::optional<std::int64_t> fired_t_ns;  ///< last order
  std::optional<Eigen::Vector2d> taken_m;  ///< the ball's centre in F when it was first had
  double corner = 0.0;                     ///< that it aims at: -1 left, 1 right, 0 none chosen yet

  PossessionMemory() = default;
  PossessionMemory(const PossessionMemory&) = default;
  PossessionMemory& operator=(const PossessionMemory&) = default;
  virtual ~PossessionMemory() = default;

  /// Looks at every cycle, also while nothing may be decided.
  virtual void watch(const PolicyConfig&, const PolicyInput&) {}
  /// Nothing may be decided in this cycle.
  virtual void interrupt() {}
  /// Its order goes out, with this command to the base.
  virtual void order(const TestDriveConfig&, const Twist&) {}
  /// Command of a test drive while its order is on its way.
  virtual Twist pending_command() const { return {}; }
};

/// What makes a policy: asked in each cycle in which something may be decided. Reason kFire: it would kick now, the
/// kicker and an order on its way aside.
template <class Memory>
using Rule = PolicyOutput(const PolicyConfig&, const RobotModel&, const Goal&, const PolicyInput&, Memory&);

}  // namespace trivela::kicking
