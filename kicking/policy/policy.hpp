#pragma once

#include <cstdint>
#include <optional>

#include "kicking/alignment/release_predictor.hpp"
#include "kicking/geometry/frames.hpp"
#include "kicking/geometry/goal.hpp"
#include "kicking/model/robot_model.hpp"
#include "kicking/policy/policy_config.hpp"
#include "kicking/policy/predictive/drive_plan.hpp"
#include "kicking/policy/predictive/opponent_watch.hpp"

namespace trivela::kicking {

/// kStopped: drive, brake, turn, settle, kick: "a two-step behaviour", the method before the paper.
/// kMoving: the paper's: alignment is evaluated in parallel with the motion.
/// The drives calibrate a robot (kicking/policy/test_drive.hpp).
/// kPredictive: fires where the probability of a ball on target, weighed against losing the ball, is highest; kLearned:
/// the same with that probability corrected by a model trained on logs; kOracle: the same on the simulator's true
/// state. In the order of the wire's Policy.
enum class PolicyName {
  kStopped,
  kMoving,
  kStandingDrive,
  kLateralDrive,
  kTurnDrive,
  kStraightDrive,
  kPredictive,
  kLearned,
  kOracle
};

inline constexpr std::size_t kPolicyCount = 9;

/// Why a policy fires or holds, in the order of the wire's DecisionReason.
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
  kWaiting
};

/// "stopped", "moving", "standing_drive", "lateral_drive", "turn_drive", "straight_drive", "predictive", "learned",
/// "oracle".
const char* name(PolicyName policy);
/// "fire", "not_playing", ...
const char* name(Reason reason);

/// What was seen of a kick.
struct SeenKick {
  std::int64_t kick_id = 0;
  std::uint32_t possession_id = 0;  ///< that it ended
  std::optional<double> x_cross_m;  ///< ball centre at the goal line, in F; none: it was not seen to cross
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
  std::optional<double> opponent_distance_m;   ///< nearest opponent to the ball; stopped and moving do not look at it
  std::optional<double> opponent_closing_mps;  ///< how fast it comes, where both are known exactly: the oracle alone
  std::optional<SeenKick> last_kick;           ///< the latest one with an outcome; the turn drive alone looks at it
};

/// How far a test drive has come. It outlives the possession.
struct TestDriveMemory {
  std::size_t level = 0;    ///< entry of the drive's list
  std::uint32_t kicks = 0;  ///< that count for this level; of the turn drive: for this step
  bool passing = false;     ///< on its way past the mark or the target; of this possession
  std::uint32_t step = 0;   ///< turn drive: halvings done
  double low_rad = 0.0;     ///< turn drive: the allowed error, as an angle, is between these
  std::optional<double> high_rad;
  double late_sum_m = 0.0;  ///< turn drive: of this step's balls, beyond the target in the sense of turning
  Twist command{};          ///< of the order: it goes on until the ball has left
  std::optional<std::uint32_t> awaited_possession;  ///< turn drive: its kick has not been seen yet
};

/// What the predictive policy remembers of a possession.
struct PredictiveMemory {
  OpponentWatch opponent{};
  DrivePlan plan = DrivePlan::kOnto;  ///< that it drives by
  std::optional<Twist> command;       ///< of the last cycle
  std::optional<Twist> twist;         ///< of the robot in the last cycle
  double speed_jump_mps = 0.0;        ///< by which the twist changed more than the base can
};

/// What a policy remembers from cycle to cycle. A new possession starts it afresh, but for a drive's progress.
struct PolicyMemory {
  std::optional<std::uint32_t> possession_id;
  std::optional<std::int64_t> fired_t_ns;           ///< last order of this possession
  bool aligned_before = false;                      ///< moving: in the previous cycle
  bool turning = false;                             ///< stopped: has come to rest, turns or settles
  std::optional<std::int64_t> settling_since_t_ns;  ///< stopped, standing drive
  TestDriveMemory drive;
  PredictiveMemory predictive;
};

/// One decision with every number behind it.
struct Judgement {
  bool fire = false;
  Reason reason = Reason::kNotPlaying;
  double target_x_m = 0.0;  ///< aim point in F
  double target_y_m = 0.0;
  double target_z_m = 0.0;
  double distance_m = 0.0;           ///< ball centre to target, horizontal
  std::optional<double> v0_mps;      ///< exit speed for a robot at rest; none: the angle is too flat for the height
  std::optional<double> v_kick_mps;  ///< exit speed asked of the kicker
  std::optional<double> power;       ///< set-point, fractional
  double alpha_rad = 0.0;            ///< right positive
  double beta_rad = 0.0;             ///< with the sign of omega
  bool aligned = false;
  std::optional<double> offset_right_m;
  double left_m = 0.0;
  double right_m = 0.0;
  std::optional<Crossing> predicted;  ///< of an order that goes out now
  std::optional<double> p_on_target;  ///< predicted probability that this kick is on target; none: not computed
  double fire_after_s = 0.0;          ///< energise the coil so much later than the input's instant, within a cycle
  Twist drive{};                      ///< command until the next cycle, in R
};

/// Fire or hold? A pure function of its arguments but for the policy's own memory, which it brings up to date; nothing
/// allocates. A policy that is not in charge is judged by the same function with a memory of its own. It never fires
/// when the game stands, the ball is not held, the kicker is not ready, the state is older than max_state_age_s or not
/// finite, no set-point reaches the target height (but for kStandingDrive, which kicks for the laser, and the
/// predictive ones, which choose their height: where full power falls short of the line), or an order of this
/// possession is pending.
Judgement judge(PolicyName policy, const PolicyConfig& config, const RobotModel& robot, const Goal& goal,
                const PolicyInput& input, PolicyMemory& memory);

}  // namespace trivela::kicking
