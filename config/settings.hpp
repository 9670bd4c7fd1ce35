#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "config/devices.hpp"
#include "config/text/field_types.hpp"
#include "kicking/geometry/goal.hpp"
#include "kicking/learning/kicker_estimate.hpp"
#include "kicking/policy/policy.hpp"

namespace trivela::config {

inline constexpr std::array<std::string_view, 6> kLogLevels{"trace", "debug", "info", "warn", "error", "off"};

/// Which robot this is and how its cycle runs.
struct Run {
  std::string team = "team";  ///< its name, in those of the logs
  std::uint32_t robot_id = 1;
  double cycle_s = 0.02;           ///< control cycle (CAMBADA release 1.0: MOTION_TICK 20 ms)
  std::uint32_t session = 0;       ///< upper 15 bits of every kick_id; 0: by the instant of the start
  bool match_mode = false;         ///< a match is on: what changes a log or a robot by hand is refused
  bool lockstep = false;           ///< wait for every input of a cycle and tell the simulator when it is finished
  bool one_process = false;        ///< odometry, world_state and kick_decision share one, trivela-chain
  double referee_timeout_s = 1.0;  ///< without a command for longer the game is stopped; real time alone
  std::string robot = "robots/cambada_1.toml";      ///< relative to the file that names it
  std::string scenario = "scenarios/default.toml";  ///< simulator alone
  std::string field_file;  ///< goal, field and rules in one file (config/field.hpp); empty: as the settings say
  std::uint32_t memory_limit_mb = 1024;  ///< a node that takes more ends, to be started again
  std::string log_level = "info";        ///< one of kLogLevels
};

/// The DDS domain.
struct Domain {
  std::uint32_t domain_id = 42;
  std::string tag = "trivela";  ///< discovery tag: participants of different tags never hear each other
  std::string dds_file;         ///< a Cyclone configuration for a team network; empty: loopback
};

/// The field around the goal.
struct FieldLines {
  double side_line_x_m = 6.0;  ///< of the 18 x 12 m field, whose goal lines are at goal.y_m and -goal.y_m
};

/// Noise of the wheel odometry.
struct Odometry {
  double wheel_sd_radps = 1.0;        ///< noise and slip of one wheel's speed
  double gyro_sd_radps = 0.02;        ///< noise of the gyro
  double drive_timeout_s = 0.2;       ///< without a drive command for longer the base stops
  double team_drive_timeout_s = 0.2;  ///< the same of the team's own program, where it is in charge
  double drift_ratio = 0.05;          ///< position error per metre driven
  double heading_drift_ratio = 0.02;  ///< heading error per radian turned

  bool operator==(const Odometry&) const = default;
};

/// Filters of the world state.
struct WorldState {
  double pose_sd_m = 0.12;  ///< self-localisation, per frame and axis
  double pose_sd_heading_rad = kicking::radians(1.0);
  double relocalise_distance_m = 1.0;   ///< an innovation beyond it is a kidnapped robot ...
  std::uint32_t relocalise_frames = 3;  ///< ... when this many frames in a row agree
  double history_s = 0.5;               ///< odometry kept to look up the exposure of a frame
  double velocity_time_constant_s = 0.03;
  double ball_time_constant_s = 0.04;
  double possession_forget_s = 0.15;   ///< a ball not seen for longer is not held ...
  double ball_forget_s = 0.5;          ///< ... and then unknown
  double handler_half_width_m = 0.12;  ///< possession: ball centre within this of the handler's axis ...
  double handler_reach_m = 0.10;       ///< ... and of its resting place
  double possession_debounce_s = 0.04;
};

/// When the robot moves as kick_decision says: always, while the ball lies in its handler, or never, which leaves its
/// `drive` a proposal. Otherwise it moves as the team's own program says, on `team_drive`.
enum class DriveMode : std::uint8_t { kAlways, kWithBall, kAdvice };

/// Who is in charge: `random`, where it names policies, before `policy_by_robot`, where that does, before the halves.
struct KickDecision {
  std::vector<kicking::PolicyName> policy_by_half = {kicking::PolicyName::kMoving};  ///< the last one goes on
  std::vector<kicking::PolicyName> policy_by_robot;  ///< robot n's at n - 1; the rest of the team: by half
  std::vector<kicking::PolicyName> random;           ///< one of these is drawn for each possession
  std::vector<double> random_probabilities;          ///< of those, their sum 1; empty: alike
  std::uint64_t assignment_seed = 1;                 ///< of the draw
  std::string learned_model;  ///< file of `trivela study learn`, read into policy.learned; policy "learned" needs one
  bool shadows = true;        ///< evaluate the other policies, too
  double order_validity_s = 0.05;  ///< an order older than this is refused
  DriveMode drive = DriveMode::kAlways;
  bool standby = false;  ///< a second decision node stands by; in real time alone

  /// From now on this policy plays every possession of every robot.
  void put_in_charge(kicking::PolicyName policy) {
    policy_by_half = {policy};
    policy_by_robot.clear();
    random.clear();
    random_probabilities.clear();
  }
};

/// What a kicker's board may be able to do beyond firing (hal::KickerCapabilities).
enum class Capability { kChargeControl, kVoltage, kDischarge, kWatchdog };

/// What the driver refuses.
struct KickerDriver {
  double min_interval_s = 0.5;        ///< between two kicks
  double min_charge_ratio = 0.9;      ///< of the full capacitor energy
  double max_order_age_s = 0.1;       ///< an order that was judged longer ago is refused, whatever it says of itself
  double future_tolerance_s = 0.025;  ///< an order from further ahead is refused; a cycle and what clocks differ by
  double link_timeout_s = 0.1;        ///< no device sample for longer: fault
  double voltage_rise_v = 5.0;        ///< by so much a capacitor that is charged rises within voltage_rise_s, or fault
  double voltage_rise_s = 1.0;
  std::vector<Capability> demand;  ///< what the kicker's board must be able to do, or the driver does not start
};

/// Tracking of a shot.
struct ShotObserver {
  double history_s = 0.6;           ///< frames kept for a receipt that arrives late
  double time_out_s = 3.0;          ///< after the release; what has not crossed by then is short
  double ball_sd_m = 0.03;          ///< of one observation and axis, before flights have shown what it is
  double label_probability = 0.95;  ///< an outcome that is less certain is unknown
  double lost_s = 0.3;              ///< without an observation for longer the ball is lost
  double rest_speed_mps = 0.3;      ///< slower is at rest
};

/// What becomes of what the kicks show of the kicker: nothing is learned, it is learned and recorded, or decisions go
/// by it, too.
enum class SelfCalibrationMode : std::uint8_t { kOff, kShadow, kOn };

/// Learning of the kicker in play.
struct SelfCalibration {
  SelfCalibrationMode mode = SelfCalibrationMode::kShadow;
  kicking::KickerChange change{};  ///< how far it may be from its file
  std::string state_file;          ///< the last estimate, with which the next match begins; empty: none
  double state_max_age_h = 24.0;   ///< an older one is not used
};

/// What the simulated robot's devices are to its nodes.
enum class SimulatedDevices : std::uint8_t {
  kBus,      ///< topics, and the simulator writes `referee`
  kEmulated  ///< the board and the drives that hal names, at their ends of lines, and a referee box; real time alone
};

/// What the simulator plays.
struct Simulator {
  std::int64_t seed = 1;
  std::uint32_t halves = 2;
  double half_minutes = 5.0;
  std::uint32_t max_possessions = 0;  ///< a half ends after so many of them, if it has not before; 0: no such limit
  bool paired_halves = false;         ///< every half has the possessions of the first
  double pace = 0.0;  ///< simulated seconds a second, at most, in lockstep; 0: as fast as the nodes answer
  SimulatedDevices devices = SimulatedDevices::kBus;
  bool referee =
      true;  ///< it says its referee's word; false: the robot hears another one, and the world goes on by its own
};

struct Recorder {
  std::string log = "{team}-{robot}-{time}.db";  ///< a file, a folder or a pattern (robot/recording/log_family.hpp)
  std::uint32_t queue_capacity = 65536;
  double group_commit_s = 0.1;
};

/// Records a range finder's scans beside the match log.
struct ScanRecorder {
  bool enabled = false;                                       ///< in lockstep the simulator waits for it
  RangeFinderDevice device;                                   ///< sim, tcp://HOST:PORT or a serial device
  std::string file = "scans.db";                              ///< one that exists stays; the next has a number
  double mount_x_m = 4.0;                                     ///< scanner from the ball at the launch, along the kick
  double mount_z_m = 0.05;                                    ///< over the floor
  double mount_front_elevation_rad = kicking::radians(90.0);  ///< of its front; 90 degrees: it looks straight up
  bool mount_mirrored = false;                                ///< it lies on its other side
};

/// What a team is called by the referee box of before 2016.
enum class TeamColour : std::uint8_t { kCyan, kMagenta };

/// The connection to the league's referee box.
struct Refbox {
  std::string host = "127.0.0.1";         ///< name or address of the box
  std::uint32_t port = 28097;             ///< RoboCup-MSL/RefBox
  std::string group;                      ///< our multicast group, 224.16.32.N, by which the box names us
  std::string team_name;                  ///< ... and what we call ourselves
  std::string intention = "play";         ///< of the team, for the audience
  bool letters = false;                   ///< the box speaks the protocol of one letter, to version 1.5.0
  TeamColour colour = TeamColour::kCyan;  ///< in that protocol
  /// Whom it is for: the box takes one connection of a team. Empty: run.robot_id alone.
  std::vector<std::uint32_t> robots;
  double period_s = 0.08;          ///< between two repetitions of `referee`, and of what the box is told
  double acknowledgement_s = 0.4;  ///< what we sent waits for longer: the connection is lost
};

/// This machine's place on the team's bus.
struct TeamLink {
  std::uint32_t domain_id = 43;  ///< of the team's bus
  std::string dds_file;          ///< its Cyclone configuration
  std::string interface;         ///< by which this machine is on it: joined again where its address goes or comes
  bool base = false;             ///< it is the base, which passes its referee on; else robot run.robot_id
  bool referee = true;           ///< a robot's referee is the base's; false: it has one of its own
};

/// Everything a node takes from default.toml, defaults included.
struct Settings {
  Run run;
  Domain domain;
  Hal hal;
  kicking::Goal goal;
  FieldLines field;
  kicking::PolicyConfig policy;
  Odometry odometry;
  WorldState world_state;
  KickDecision kick_decision;
  KickerDriver kicker_driver;
  ShotObserver shot_observer;
  SelfCalibration self_calibration;
  Simulator simulator;
  Recorder recorder;
  ScanRecorder scan_recorder;
  Refbox refbox;
  TeamLink team_link;
};

/// The defaults overridden by `path`; relative file names in it are relative to its folder, robot and scenario that it
/// does not name the shipped ones (config/text/installation.hpp). Throws config::Error.
Settings load_settings(const std::filesystem::path& path);

/// Makes relative names of files whole, for a copy of the settings that is read from elsewhere.
void make_files_whole(Settings& settings);

/// Throws Error naming key and value where the policies in charge make no sense together.
void check_policies(const KickDecision& settings, const std::string& source);

/// Lines of TOML such as `run.robot_id = 2` on top, and what follows from all of them together: the cycle of the
/// policies, their learned model. Relative file names are relative to the working directory. Throws Error naming line
/// or key after what the lines are `called`, also for policies that do not go together.
void override_settings(Settings& settings, const std::vector<std::string>& lines,
                       const std::string& called = "settings");

/// Every setting as TOML; of policies from outside those that are in charge, and what is not usual of others.
std::string to_toml_text(const Settings& settings);

/// The processes of a robot's decision path, without "trivela-": odometry, world_state and kick_decision, or chain.
std::vector<std::string> decision_path(const Settings& settings);

/// Every setting by its key, e.g. "policy.predictive.threshold", with its value as TOML has it.
std::map<std::string, std::string> setting_values(const Settings& settings);

}  // namespace trivela::config
