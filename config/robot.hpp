#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/calibration.hpp"
#include "config/settings.hpp"
#include "config/text/field_types.hpp"
#include "kicking/model/distance_table.hpp"
#include "kicking/model/omni_kinematics.hpp"
#include "kicking/model/robot_model.hpp"

namespace trivela::config {

using kicking::WheelBase;

/// What a robot's file says of a kind of kick beside the first, whose model is of model.further_kinds.
struct KickKind {
  std::string name = "flat";
  std::string source = "not measured";
  std::optional<std::uint8_t> lever{};  ///< height of the kicker's lever, as Robot::lever
};

/// One robot's file: who it is, where its numbers come from, its kick model and its wheels.
struct Robot {
  std::string name = "cambada_1";
  std::string source = "CAMBADA release 1.0 (2015), config/kicker.map, robot 1";
  kicking::RobotModel model{};
  WheelBase base{};
  std::optional<kicking::TrueTable> true_table{};        ///< in place of model.table; load_robot() refuses such a file
  std::optional<kicking::DistanceTable> height_table{};  ///< what model.table was made from, where the file has it
  std::optional<Calibration> calibration{};              ///< where measured figures come from
  std::optional<std::uint8_t> lever{};  ///< height of the kicker's lever at which the table was measured
  std::vector<KickKind> kinds{};        ///< beside the first: [[kinds]], in the order of model.further_kinds
};

/// Reads config/robots/NAME.toml; what the file does not name keeps the default, but for the table, which must be
/// whole: kind, powers and exit speeds, and may have an exit angle and the lever's height for each power; the lever is
/// too slow to be moved between a decision and its kick, so that the heights of one table are the same. In place of
/// [table] a file may have [height_table], powers over distances: model.table is then kicking::effective_table() by the
/// default settings' law and target height; robot_for() makes it again for others. Throws Error: also for a table of
/// kind "true", which the drag-free laws of the policies must not be given, and for set-points that do not rise.
Robot load_robot(const std::filesystem::path& path);

/// The law by which a height table tells exit speeds: policy.height_law where somebody in charge aims by it (stopped,
/// moving), so that a robot at rest kicks with exactly the table's power; else the exact law, which balls that passed
/// at a height follow.
kicking::HeightLaw height_table_law(const Settings& settings);

/// The robot as it plays with these settings: a height table is read by height_table_law() for policy.target_height_m;
/// any other robot is what it was. Everything that plays, on the bus and in process, takes its robot from here. Throws
/// Error naming the robot where the table does not go with the settings.
Robot robot_for(Robot robot, const Settings& settings);

/// The same as load_robot() for the tools that calibrate: a table of kind "true" comes back as true_table.
Robot load_robot_of_any_table(const std::filesystem::path& path);

/// What a robot's file does not name though its default is not 0, by table or key: "base", "kicker.delay_s",
/// "kinds[0].kicker.delay_s". Those are robot 1 of CAMBADA's, of a further kind the first kind's. Throws Error where
/// the file is no TOML.
std::vector<std::string> defaulted_figures(const std::filesystem::path& path);

/// The devices as this robot has them: its kicker's lever stands at the table's height. Throws Error where hal.ioboard
/// says another one.
Hal hal_for(Hal devices, const Robot& robot);

/// The robot as TOML that load_robot() reads back.
std::string to_toml_text(const Robot& robot);

}  // namespace trivela::config
