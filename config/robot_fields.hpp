#pragma once

#include <fmt/core.h>

#include <stdexcept>

#include "config/robot.hpp"
#include "config/text/field_types.hpp"
#include "kicking/model/omni_kinematics.hpp"

/// The keys of a robot's file with its [calibration], each named once.
namespace trivela::kicking {

inline config::EnumNames<TableKind> names_of(TableKind) {
  return {{"effective", TableKind::kEffective}, {"true", TableKind::kTrue}};
}

void fields(auto& v, Transfer& t) {
  v("forward_ratio", t.forward, config::Range{0.0, 1.5});
  v("backward_ratio", t.backward, config::Range{0.0, 1.5});
  v("lateral_ratio", t.lateral, config::Range{0.0, 1.5});
}

void fields(auto& v, KickSpreads& s) {
  v("speed_sd_ratio", s.speed_sd_ratio, config::Range{0.0, 0.5});
  v("exit_angle_sd_deg", config::Degrees{s.exit_angle_sd_rad}, config::Range{0.0, 20.0});
  v("direction_sd_deg", config::Degrees{s.direction_sd_rad}, config::Range{0.0, 20.0});
  v("delay_sd_s", s.delay_sd_s, config::Range{0.0, 0.1});
  v("table_sd_ratio", s.table_sd_ratio, config::Range{0.0, 0.5});
  v("transfer_sd_ratio", s.transfer_sd_ratio, config::Range{0.0, 1.0});
  v("exit_angle_se_deg", config::Degrees{s.exit_angle_se_rad}, config::Range{0.0, 20.0});
  v("direction_se_deg", config::Degrees{s.direction_se_rad}, config::Range{0.0, 20.0});
  v("delay_se_s", s.delay_se_s, config::Range{0.0, 0.2});
}

void fields(auto& v, RobotModel& m) {
  v("exit_angle_deg", config::Degrees{m.exit_angle_rad}, config::Range{0.0, 80.0});
  v("direction_deg", config::Degrees{m.direction_rad}, config::Range{-20.0, 20.0});
  v("delay_s", m.delay_s, config::Range{0.0, 0.5});
  v("ball_offset_m", m.ball_offset_m, config::Range{0.1, 0.6});
  v("alpha_slope_deg_per_mps", config::Degrees{m.alpha_slope_rad_per_mps}, config::Range{-45.0, 45.0});
  v("beta_slope_s", m.beta_slope_s, config::Range{0.0, 1.0});
  v("ball_mass_kg", m.ball.mass_kg, config::Range{0.05, 2.0});
  v("ball_radius_m", m.ball.radius_m, config::Range{0.02, 0.25});
  v("transfer_paper", m.transfer_paper);
  v("transfer_exact", m.transfer_exact);
  v("lever_s", m.lever_s, config::Range{0.0, 5.0});
  v("spreads", m.spreads);
}

void fields(auto& v, WheelBase& b) {
  v("wheel_angles_rad", b.wheel_angles_rad, config::Range{-6.3, 6.3});
  v("wheel_distance_m", b.wheel_distance_m, config::Range{0.02, 0.6});
  v("wheel_radius_m", b.wheel_radius_m, config::Range{0.005, 0.3});
  config::require(v, "wheel_angles_rad", [&] { OmniKinematics{b}; });
}

}  // namespace trivela::kicking

namespace trivela::config {

inline constexpr Range kKickCounts{0.0, 1e6};
inline constexpr Range kErrors{0.0, 1e3};

void fields_of_origin(auto& v, FigureOrigin& o) {
  v("date", o.date);
  v("kicks", o.kicks, kKickCounts);
  v("files", o.files);
}

void fields(auto& v, TableOrigin& o) {
  fields_of_origin(v, o);
  v("trials", o.trials, kKickCounts);
  v("exit_speed_sds_mps", o.exit_speed_sds_mps, kErrors);
  v("exit_speed_sd_mps", o.exit_speed_sd_mps, kErrors);
  v("isotonic", o.isotonic);
}

void fields(auto& v, ExitAngleOrigin& o) {
  fields_of_origin(v, o);
  v("exit_angle_se_deg", Degrees{o.exit_angle_se_rad}, kErrors);
  v("spread_deg", Degrees{o.spread_rad}, kErrors);
}

void fields(auto& v, DeflectionOrigin& o) {
  fields_of_origin(v, o);
  v("alpha_slope_se_deg_per_mps", Degrees{o.alpha_slope_se_rad_per_mps}, kErrors);
  v("rms_deg", Degrees{o.rms_rad}, kErrors);
  v("lateral_ratio_se", o.lateral_ratio_se, kErrors);
}

void fields(auto& v, RotationOrigin& o) {
  fields_of_origin(v, o);
  v("beta_slope_se_s", o.beta_slope_se_s, kErrors);
  v("rms_deg", Degrees{o.rms_rad}, kErrors);
}

void fields(auto& v, TransferOrigin& o) {
  fields_of_origin(v, o);
  v("exact_forward_se_ratio", o.exact_forward_se_ratio, kErrors);
  v("exact_backward_se_ratio", o.exact_backward_se_ratio, kErrors);
  v("paper_forward_se_ratio", o.paper_forward_se_ratio, kErrors);
  v("paper_backward_se_ratio", o.paper_backward_se_ratio, kErrors);
}

void fields(auto& v, DelayOrigin& o) {
  fields_of_origin(v, o);
  v("delay_se_s", o.delay_se_s, kErrors);
  v("delay_sd_s", o.delay_sd_s, kErrors);
}

void fields(auto& v, DirectionOrigin& o) {
  fields_of_origin(v, o);
  v("direction_sd_se_deg", Degrees{o.direction_sd_se_rad}, kErrors);
  v("observer_sd_deg", Degrees{o.observer_sd_rad}, kErrors);
}

void fields(auto& v, PlayOrigin& o) {
  fields_of_origin(v, o);
  v("speed_se_ratio", o.speed_se_ratio, kErrors);
  v("exit_angle_se_deg", Degrees{o.exit_angle_se_rad}, kErrors);
  v("direction_se_deg", Degrees{o.direction_se_rad}, kErrors);
  v("delay_se_s", o.delay_se_s, kErrors);
  v("along_se_ratio", o.along_se_ratio, kErrors);
  v("sideways_se_ratio", o.sideways_se_ratio, kErrors);
}

void fields(auto& v, Calibration& c) {
  v("source", c.source);
  v("date", c.date);
  v("kicks", c.kicks, kKickCounts);
  v("table", c.table);
  v("exit_angle", c.exit_angle);
  v("deflection", c.deflection);
  v("rotation", c.rotation);
  v("transfer", c.transfer);
  v("delay", c.delay);
  v("direction", c.direction);
  v("play", c.play);
}

/// The table as the file has it, before it is known to be one.
struct TableColumns {
  kicking::TableKind kind = kicking::TableKind::kEffective;
  std::vector<double> powers;
  std::vector<double> exit_speeds_mps;
  std::optional<std::vector<double>> exit_angles_deg;
  std::optional<std::vector<double>> levers;
};

/// [height_table] as the file has it.
struct DistanceColumns {
  std::vector<double> distances_m;
  std::vector<double> powers;
};

/// [[kinds]]: a kind of kick beside the first one.
struct KindFile {
  KickKind kind;
  kicking::RobotModel model;  ///< of the first kind, where the kind says nothing else
  std::optional<TableColumns> table;
};

struct RobotFile {
  Robot robot;
  std::vector<KindFile> kinds;
  std::optional<TableColumns> table;
  std::optional<DistanceColumns> height_table;
};

/// Lets the set-points under `key` rise from above 0, where `v` reads a file.
void require_rising(auto& v, std::string_view key, const std::vector<double>& column) {
  require(v, key, [&] {
    for (std::size_t i = 0; i < column.size(); ++i) {
      if (const double before = i == 0 ? 0.0 : column[i - 1]; !(column[i] > before))
        throw std::invalid_argument{fmt::format("[{}] must be above {}", i, before)};
    }
  });
}

void fields(auto& v, DistanceColumns& t) {
  v("distances_m", t.distances_m, Range{0.5, 30.0});
  v("powers", t.powers, Range{0.0, 1e6});
  require_rising(v, "powers", t.powers);
}

void fields(auto& v, TableColumns& t) {
  v("kind", t.kind);
  v("powers", t.powers, Range{0.0, 1e6});
  v("exit_speeds_mps", t.exit_speeds_mps, Range{0.1, 40.0});
  v("exit_angles_deg", t.exit_angles_deg, Range{0.0, 80.0});
  v("levers", t.levers, Range{0.0, 205.0});
  require_rising(v, "powers", t.powers);
  require_rising(v, "exit_speeds_mps", t.exit_speeds_mps);
}

void fields(auto& v, KindFile& k) {
  v("name", k.kind.name);
  v("source", k.kind.source);
  v("table", k.table);
  v("kicker", k.model);
}

void fields(auto& v, RobotFile& f) {
  v("name", f.robot.name);
  v("source", f.robot.source);
  v("table", f.table);
  v("height_table", f.height_table);
  v("kicker", f.robot.model);
  v("kinds", f.kinds, KindFile{.kind{}, .model = f.robot.model, .table{}});
  v("base", f.robot.base);
  v("calibration", f.robot.calibration);
}

}  // namespace trivela::config
