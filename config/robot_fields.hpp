#pragma once

#include <fmt/core.h>

#include <stdexcept>

#include "config/calibration_fields.hpp"
#include "config/robot.hpp"
#include "config/text/field_types.hpp"

/// The keys of a robot's file, each named once.
namespace trivela::kicking {

template <class V>
void fields(V& v, Transfer& t) {
  v("forward_ratio", t.forward, config::Range{0.0, 1.5});
  v("backward_ratio", t.backward, config::Range{0.0, 1.5});
  v("lateral_ratio", t.lateral, config::Range{0.0, 1.5});
}

template <class V>
void fields(V& v, KickSpreads& s) {
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

template <class V>
void fields(V& v, RobotModel& m) {
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

template <class V>
void fields(V& v, WheelBase& b) {
  v("wheel_angles_rad", b.wheel_angles_rad, config::Range{-6.3, 6.3});
  v("wheel_distance_m", b.wheel_distance_m, config::Range{0.02, 0.6});
  v("wheel_radius_m", b.wheel_radius_m, config::Range{0.005, 0.3});
}

}  // namespace trivela::kicking

namespace trivela::config {

template <>
struct Names<kicking::TableKind> {
  static constexpr std::array<std::pair<std::string_view, kicking::TableKind>, 2> entries{
      {{"effective", kicking::TableKind::kEffective}, {"true", kicking::TableKind::kTrue}}};
};

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
template <class V>
void require_rising(V& v, std::string_view key, const std::vector<double>& column) {
  if constexpr (requires { v.require(key, [] {}); })
    v.require(key, [&] {
      for (std::size_t i = 0; i < column.size(); ++i) {
        if (const double before = i == 0 ? 0.0 : column[i - 1]; !(column[i] > before))
          throw std::invalid_argument{fmt::format("[{}] must be above {}", i, before)};
      }
    });
}

template <class V>
void fields(V& v, DistanceColumns& t) {
  v("distances_m", t.distances_m, Range{0.5, 30.0});
  v("powers", t.powers, Range{0.0, 1e6});
  require_rising(v, "powers", t.powers);
}

template <class V>
void fields(V& v, TableColumns& t) {
  v("kind", t.kind);
  v("powers", t.powers, Range{0.0, 1e6});
  v("exit_speeds_mps", t.exit_speeds_mps, Range{0.1, 40.0});
  v("exit_angles_deg", t.exit_angles_deg, Range{0.0, 80.0});
  v("levers", t.levers, Range{0.0, 205.0});
  require_rising(v, "powers", t.powers);
  require_rising(v, "exit_speeds_mps", t.exit_speeds_mps);
}

template <class V>
void fields(V& v, KindFile& k) {
  v("name", k.kind.name);
  v("source", k.kind.source);
  v("table", k.table);
  v("kicker", k.model);
}

template <class V>
void fields(V& v, RobotFile& f) {
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
