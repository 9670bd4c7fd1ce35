#include <fmt/core.h>
#include <fmt/os.h>

#include "cli/options/output.hpp"
#include "cli/scan/verb_parts.hpp"
#include "cli/verbs.hpp"
#include "config/robot.hpp"
#include "config/text/installation.hpp"
#include "kicking/random/draws.hpp"

namespace trivela::cli {
namespace {

constexpr std::int64_t kEntered_ns = 300'000'000;  // the operator enters a set-point so long before the kick

sim::LaserModel laser_model(const SyntheticFlags& flags, const MountFlags& mount) {
  sim::LaserModel laser;
  laser.x_m = mount.laser_x_m;
  laser.z_m = mount.laser_z_m;
  laser.front_elevation_rad = kicking::radians(mount.front_elevation_deg);
  laser.mirrored = mount.mirrored;
  laser.range_sd_m = flags.range_sd_m;
  laser.dropout_ratio = flags.dropout_ratio;
  laser.mixed_ratio = flags.mixed_ratio;
  if (flags.scanner == "urg-04lx") {  // steps 44 to 725, front 384, 1024 a revolution (SCIP 2.0 specification table)
    const double step_rad = kicking::radians(360.0 / 1024.0);
    laser.geometry = {.beams = 682,
                      .first_angle_rad = (44 - 384) * step_rad,
                      .step_rad = step_rad,
                      .beam_period_s = 0.1 / 1024.0,
                      .scan_period_s = 0.1,
                      .min_range_m = 0.02,
                      .max_range_m = 5.6};
  }
  return laser;
}

std::vector<sim::SyntheticKick> kicks_of(const SyntheticFlags& flags) {
  std::vector<sim::SyntheticKick> kicks;
  const auto add = [&](double speed_mps, std::optional<double> power) {
    for (int trial = 0; trial < flags.lobs; ++trial) {
      const auto number = static_cast<std::uint32_t>(kicks.size());
      const auto spread = kicking::Draws(flags.seed, number).normals(kicking::Role::kKicker, 0);
      kicks.push_back({.exit_speed_mps = speed_mps + spread[0] * flags.speed_sd_mps,
                       .exit_angle_rad = kicking::radians(flags.exit_angle_deg + spread[1] * flags.angle_sd_deg),
                       .drag_coefficient = flags.cd,
                       .power = power});
    }
  };
  if (!flags.exit_speed_mps.empty()) {
    for (const double speed_mps : flags.exit_speed_mps) add(speed_mps, std::nullopt);
  } else {
    const kicking::RobotModel model =
        flags.set_points.empty() ? kicking::RobotModel{} : config::load_robot(flags.set_points).model;
    for (const kicking::SetPoint& point : model.table.set_points()) add(point.speed_mps, point.power);
  }
  return kicks;
}

void write_truth(const std::string& path, const std::vector<sim::KickedTruth>& truth) {
  auto out = fmt::output_file(path);
  out.print("# true values of synthetic kicks, at the release\n");
  out.print("launch_t_ns,power,exit_speed_mps,exit_angle_deg,drag_coefficient\n");
  for (const sim::KickedTruth& row : truth) {
    out.print("{},{},{:.6f},{:.6f},{:.6f}\n", row.launch_t_ns, row.kick.power ? fmt::format("{}", *row.kick.power) : "",
              row.kick.exit_speed_mps, kicking::degrees(row.kick.exit_angle_rad), row.kick.drag_coefficient);
  }
}

}  // namespace

SyntheticScans synthesize(const SyntheticFlags& flags, const MountFlags& mount) {
  const sim::LaserModel laser = laser_model(flags, mount);
  SyntheticScans made;
  made.record = sim::synthesize_record(laser, {.kicks = kicks_of(flags)}, sim::BallPhysics{}, flags.seed);
  made.session = {.identity = {"synthetic", flags.scanner, fmt::format("seed {}", flags.seed), "", "none"},
                  .geometry = laser.geometry,
                  .mount = made.record.mount,
                  .simulated = true,
                  .source = fmt::format("synthetic, seed {}", flags.seed),
                  .software_version = config::software_version()};
  return made;
}

int write_synthetic(const SyntheticScans& scans, const std::filesystem::path& out, const std::string& truth_csv) {
  require_writable("--truth", truth_csv);
  log::WriterOptions options;
  options.queue_capacity += scans.record.scans.size();  // all come at once
  log::ScanWriter writer(out, scans.session, options);
  for (const sim::KickedTruth& kicked : scans.record.truth) {
    if (kicked.kick.power) writer.set_point({.t_ns = kicked.launch_t_ns - kEntered_ns, .power = *kicked.kick.power});
  }
  for (const kicking::lob::Scan& scan : scans.record.scans) writer.push(scan);
  writer.finalise();
  if (!truth_csv.empty()) write_truth(truth_csv, scans.record.truth);
  fmt::print("{}: {} scans of {} kicks\n{}\n", out.string(), scans.record.scans.size(), scans.record.truth.size(),
             kSyntheticNotice);
  return kDone;
}

}  // namespace trivela::cli
