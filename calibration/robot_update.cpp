#include "calibration/robot_update.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "config/text/error.hpp"
#include "evaluator/render/write_file.hpp"
#include "kicking/geometry/angle.hpp"

namespace trivela::calibration {
namespace {

// A kicker changes by more from one day to the next: an error below it is none.
constexpr double kDailyAngle_rad = kicking::radians(0.1);
constexpr double kDailyDelay_s = 0.003;

using kicking::degrees;

// What a file says: figures with five decimals in its unit, errors with three digits.
double figure(double value) { return std::round(value * 1e5) / 1e5; }
double figure_deg(double angle_rad) { return kicking::radians(figure(degrees(angle_rad))); }
double error(double value) { return std::stod(fmt::format("{:.3g}", value)); }
double error_deg(double angle_rad) { return kicking::radians(error(degrees(angle_rad))); }

std::string number(double value) { return fmt::format("{:.6g}", value); }

std::string certainty(double se, std::size_t kicks) { return fmt::format("+- {:.2g}, {} kicks", se, kicks); }

/// "table (16 kicks)" for each figure that was measured.
std::vector<std::string> measured(const config::Calibration& c) {
  std::vector<std::string> names;
  const auto add = [&](const char* name, const auto& origin) {
    if (origin) names.push_back(fmt::format("{} ({} kicks)", name, origin->kicks));
  };
  add("table", c.table);
  add("exit angle", c.exit_angle);
  add("alpha", c.deflection);
  add("beta", c.rotation);
  add("transfer", c.transfer);
  add("delay", c.delay);
  add("direction", c.direction);
  add("all of it in play", c.play);
  return names;
}

std::vector<std::string> not_measured(const config::Calibration& c) {
  std::vector<std::string> names;
  if (c.play) return {"ball", "wheels"};
  if (!c.table) names.emplace_back("table");
  if (!c.exit_angle) names.emplace_back("exit angle");
  if (!c.deflection) names.emplace_back("alpha");
  if (!c.rotation) names.emplace_back("beta");
  if (!c.transfer) names.emplace_back("transfer");
  if (!c.delay) names.emplace_back("delay");
  if (!c.direction) names.emplace_back("sideways scatter");
  names.insert(names.end(), {"ball", "wheels"});
  return names;
}

/// "1_standing" of "1_standing.scans.db" and "1_standing.db": what was recorded at one occasion.
std::string occasion(const std::string& file) { return file.substr(0, file.find('.')); }

bool same_occasions(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  return std::ranges::equal(a, b, {}, occasion, occasion);
}

config::PlayOrigin play_origin(config::FigureOrigin origin, const kicking::KickerVector& se) {
  return {std::move(origin),
          error(se[kicking::kSpeedPart]),
          error_deg(se[kicking::kElevationPart]),
          error_deg(se[kicking::kDirectionPart]),
          error(se[kicking::kDelayPart]),
          error(se[kicking::kAlongPart]),
          error(se[kicking::kSidewaysPart])};
}

/// Kicks behind all figures. The exit angle comes from the table's; the delay may come from the kicks of the others.
std::uint32_t kicks_behind(const config::Calibration& c) {
  std::uint32_t kicks = 0;
  bool delay_apart = c.delay.has_value();
  const auto add = [&](const auto& origin) {
    if (!origin) return;
    const bool shared = c.delay && same_occasions(origin->files, c.delay->files);
    kicks += shared ? std::max(origin->kicks, c.delay->kicks) : origin->kicks;
    if (shared) delay_apart = false;
  };
  add(c.table);
  add(c.deflection);
  add(c.rotation);
  add(c.transfer);
  add(c.play);
  return delay_apart ? kicks + c.delay->kicks : kicks;
}

}  // namespace

config::FigureOrigin RobotUpdate::origin(std::size_t kicks, const std::vector<std::string>& files) const {
  return {.date = date_, .kicks = static_cast<std::uint32_t>(kicks), .files = files};
}

config::Calibration& RobotUpdate::calibration() {
  if (!robot_.calibration) robot_.calibration.emplace();
  return *robot_.calibration;
}

void RobotUpdate::changed(const std::string& key, double before, double after, const std::string& certainty) {
  changes_.push_back(fmt::format("{} {} -> {} ({})", key, number(before), number(after), certainty));
}

/// Single kicks, one angle given for all, or an observer whose noise explains everything.
void RobotUpdate::unknown(const std::string& key, double before) {
  changes_.push_back(fmt::format("{} stays {}: the kicks do not show it", key, number(before)));
}

/// The standard error of a mean, as policies reckon with it; where the kicks do not show it, that of before stays.
void RobotUpdate::set_error(const std::string& key, double& before, const kicking::Estimate& mean, double daily,
                            double unit, std::size_t kicks) {
  if (std::isnan(mean.se)) return unknown(key, before / unit);
  const double after = mean.se < daily ? 0.0 : figure(mean.se / unit);
  if (after != before / unit) changed(key, before / unit, after, fmt::format("{} kicks", kicks));
  before = after * unit;
}

void RobotUpdate::set_speeds(std::span<const kicking::SetPoint> points, kicking::TableKind kind) {
  if (kind == kicking::TableKind::kTrue) {
    if (calibration().table && !robot_.true_table) {
      throw config::BadArgument(
          fmt::format("robot {} has a calibrated effective table, which a true one would replace: give the "
                      "true table a robot name and a file of its own",
                      robot_.name));
    }
    robot_.true_table.emplace(points);
  } else {
    robot_.true_table.reset();
    robot_.model.table = kicking::EffectiveTable{points};
  }
  robot_.height_table.reset();
}

void RobotUpdate::set_table(const kicking::TableFit& fit, const TableChoice& choice,
                            const std::vector<std::string>& files) {
  std::vector<kicking::SetPoint> points = fit.table();
  for (kicking::SetPoint& point : points) point.speed_mps = figure(point.speed_mps);
  const std::size_t kicks = fit.residual_mps.size();
  set_speeds(points, choice.kind);
  config::TableOrigin table{origin(kicks, files), {}, {}, {}, fit.isotonic};
  const bool spreads_known = std::ranges::all_of(fit.set_points, [](const auto& point) { return point.trials > 1; });
  if (!std::isnan(fit.exit_speed_sd_mps)) table.exit_speed_sd_mps = error(fit.exit_speed_sd_mps);
  std::vector<kicking::AnglePoint> angles;
  for (const kicking::TrialMean& point : fit.set_points) {
    table.trials.push_back(static_cast<std::uint32_t>(point.trials));
    if (spreads_known) table.exit_speed_sds_mps.push_back(error(point.exit_speed_mps.sd));
    if (choice.angle_per_set_point) angles.push_back({point.power, figure_deg(point.exit_angle_rad.mean)});
  }
  changes_.push_back(fmt::format("table: {} set-points from {} kicks, exit speed sd {}", points.size(), kicks,
                                 table.exit_speed_sd_mps ? number(fit.exit_speed_sd_mps) + " m/s" : "unknown"));
  robot_.model.exit_angles.reset();
  if (choice.angle_per_set_point) robot_.model.exit_angles.emplace(angles);
  changed("kicker.exit_angle_deg", degrees(robot_.model.exit_angle_rad), degrees(fit.exit_angle_rad.value),
          certainty(degrees(fit.exit_angle_rad.se), fit.exit_angles));
  robot_.model.exit_angle_rad = figure_deg(fit.exit_angle_rad.value);
  kicking::KickSpreads& spreads = robot_.model.spreads;
  const auto spread = [&](const char* key, double& before, double after, double unit) {
    if (!(after > 0.0)) return unknown(fmt::format("kicker.spreads.{}", key), before / unit);
    changed(fmt::format("kicker.spreads.{}", key), before / unit, after / unit, fmt::format("{} kicks", kicks));
    before = figure(after / unit) * unit;
  };
  spread("speed_sd_ratio", spreads.speed_sd_ratio, fit.exit_speed_sd_ratio, 1.0);
  spread("exit_angle_sd_deg", spreads.exit_angle_sd_rad, fit.exit_angle_sd_rad, kicking::radians(1.0));
  spread("table_sd_ratio", spreads.table_sd_ratio, fit.exit_speed_se_ratio, 1.0);
  set_error("kicker.spreads.exit_angle_se_deg", spreads.exit_angle_se_rad, fit.exit_angle_rad, kDailyAngle_rad,
            kicking::radians(1.0), fit.exit_angles);
  calibration().table = std::move(table);
  calibration().exit_angle = {origin(fit.exit_angles, files), error_deg(fit.exit_angle_rad.se),
                              error_deg(fit.angle_spread_rad)};
}

void RobotUpdate::set_deflection(const kicking::DeflectionFit& fit, const std::vector<std::string>& files) {
  const std::size_t kicks = fit.alpha_rad.size();
  config::DeflectionOrigin deflection{origin(kicks, files), error_deg(fit.line.slope.se), error_deg(fit.line.rms),
                                      std::nullopt};
  if (const auto& before = calibration().deflection) deflection.lateral_ratio_se = before->lateral_ratio_se;
  kicking::RobotModel& model = robot_.model;
  changed("kicker.alpha_slope_deg_per_mps", degrees(model.alpha_slope_rad_per_mps), degrees(fit.line.slope.value),
          certainty(degrees(fit.line.slope.se), kicks));
  model.alpha_slope_rad_per_mps = figure_deg(fit.line.slope.value);
  if (fit.lateral) {
    changed("kicker.transfer_exact.lateral_ratio", model.transfer_exact.lateral, fit.lateral->slope.value,
            certainty(fit.lateral->slope.se, kicks));
    model.transfer_exact.lateral = figure(fit.lateral->slope.value);
    deflection.lateral_ratio_se = error(fit.lateral->slope.se);
  }
  calibration().deflection = std::move(deflection);
  set_transfer_spread();
}

void RobotUpdate::set_rotation(const kicking::RotationFit& fit, const std::vector<std::string>& files) {
  const std::size_t kicks = fit.beta_rad.size();
  changed("kicker.beta_slope_s", robot_.model.beta_slope_s, fit.line.slope.value, certainty(fit.line.slope.se, kicks));
  robot_.model.beta_slope_s = figure(fit.line.slope.value);
  calibration().rotation = {origin(kicks, files), error(fit.line.slope.se), error_deg(fit.line.rms)};
}

void RobotUpdate::set_transfer(const kicking::TransferFit& fit, const std::vector<std::string>& files) {
  std::size_t kicks = 0;
  config::TransferOrigin transfer = calibration().transfer.value_or(config::TransferOrigin{});
  const auto set = [&](const char* key, double& ratio, const kicking::Estimate& estimate, std::size_t of_kicks,
                       std::optional<double>& se) {
    // Scatter may lead a little beyond what a floor can do; more than that write() refuses.
    const double nearest = std::clamp(estimate.value, 0.0, 1.5);
    const double possible = std::abs(nearest - estimate.value) <= 2.0 * estimate.se ? nearest : estimate.value;
    const char* held = possible == estimate.value ? "" : ", held to 0 to 1.5";
    changed(key, ratio, possible, certainty(estimate.se, of_kicks) + held);
    ratio = figure(possible);
    se = error(estimate.se);
  };
  kicking::RobotModel& model = robot_.model;
  if (const auto& forward = fit.forward) {
    const std::size_t n = forward->rows.size();
    set("kicker.transfer_exact.forward_ratio", model.transfer_exact.forward, forward->exact, n,
        transfer.exact_forward_se_ratio);
    set("kicker.transfer_paper.forward_ratio", model.transfer_paper.forward, forward->paper, n,
        transfer.paper_forward_se_ratio);
    kicks += n;
  }
  if (const auto& backward = fit.backward) {
    const std::size_t n = backward->rows.size();
    set("kicker.transfer_exact.backward_ratio", model.transfer_exact.backward, backward->exact, n,
        transfer.exact_backward_se_ratio);
    set("kicker.transfer_paper.backward_ratio", model.transfer_paper.backward, backward->paper, n,
        transfer.paper_backward_se_ratio);
    kicks += n;
  }
  const bool keeps_one = calibration().transfer && (!fit.forward || !fit.backward);
  std::vector<std::string> all_files = keeps_one ? transfer.files : std::vector<std::string>{};
  all_files.insert(all_files.end(), files.begin(), files.end());
  static_cast<config::FigureOrigin&>(transfer) = origin(kicks + (keeps_one ? transfer.kicks : 0), all_files);
  calibration().transfer = std::move(transfer);
  set_transfer_spread();
}

void RobotUpdate::set_transfer_spread() {
  const config::Calibration& c = calibration();
  double squares = 0.0;
  int known = 0;
  const auto add = [&](const std::optional<double>& se) {
    if (!se) return;
    squares += *se * *se;
    ++known;
  };
  if (c.deflection) add(c.deflection->lateral_ratio_se);
  if (c.transfer) {
    add(c.transfer->exact_forward_se_ratio);
    add(c.transfer->exact_backward_se_ratio);
  }
  if (known == 0) return;
  const double sd = std::sqrt(squares / known);
  changed("kicker.spreads.transfer_sd_ratio", robot_.model.spreads.transfer_sd_ratio, sd,
          fmt::format("from {} standard {}", known, known == 1 ? "error" : "errors"));
  robot_.model.spreads.transfer_sd_ratio = figure(sd);
}

void RobotUpdate::set_direction(const kicking::DirectionFit& fit, std::size_t kicks,
                                const std::vector<std::string>& files) {
  double& direction_sd_rad = robot_.model.spreads.direction_sd_rad;
  if (std::isnan(fit.sd_rad.value)) return unknown("kicker.spreads.direction_sd_deg", degrees(direction_sd_rad));
  changed("kicker.spreads.direction_sd_deg", degrees(direction_sd_rad), degrees(fit.sd_rad.value),
          certainty(degrees(fit.sd_rad.se), kicks));
  direction_sd_rad = figure_deg(fit.sd_rad.value);
  calibration().direction = {origin(kicks, files), error_deg(fit.sd_rad.se), error_deg(fit.observer_sd_rad)};
}

void RobotUpdate::set_delay(const kicking::DelayFit& fit, const std::vector<std::string>& files) {
  const std::size_t kicks = fit.residual_s.size() - fit.rejected.size();
  changed("kicker.delay_s", robot_.model.delay_s, fit.mean_s.value, certainty(fit.mean_s.se, kicks));
  robot_.model.delay_s = figure(fit.mean_s.value);
  changed("kicker.spreads.delay_sd_s", robot_.model.spreads.delay_sd_s, fit.sd_s, fmt::format("{} kicks", kicks));
  robot_.model.spreads.delay_sd_s = figure(fit.sd_s);
  set_error("kicker.spreads.delay_se_s", robot_.model.spreads.delay_se_s, fit.mean_s, kDailyDelay_s, 1.0, kicks);
  calibration().delay = {origin(kicks, files), error(fit.mean_s.se), error(fit.sd_s)};
}

void RobotUpdate::set_kind(std::size_t kind, const kicking::TableFit& table, const kicking::DelayFit& delay,
                           const kicking::DirectionFit& direction, const std::vector<std::string>& files) {
  kicking::RobotModel& model = robot_.model.further_kinds.at(kind - 1);
  const std::string key = fmt::format("kinds[{}].", kind - 1);
  std::vector<kicking::SetPoint> points = table.table();
  for (kicking::SetPoint& point : points) point.speed_mps = figure(point.speed_mps);
  const double before_mps = model.table.back().speed_mps;
  model.table = kicking::EffectiveTable{points};
  const std::size_t kicks = table.residual_mps.size();
  changed(key + "table, fastest", before_mps, model.table.back().speed_mps, fmt::format("{} kicks", kicks));
  changed(key + "kicker.delay_s", model.delay_s, delay.mean_s.value, certainty(delay.mean_s.se, kicks));
  model.delay_s = figure(delay.mean_s.value);
  model.transfer_exact = robot_.model.transfer_exact;
  kicking::KickSpreads& spreads = model.spreads;
  spreads.delay_sd_s = figure(delay.sd_s);
  if (table.exit_speed_sd_ratio > 0.0) spreads.speed_sd_ratio = figure(table.exit_speed_sd_ratio);
  if (table.exit_speed_se_ratio > 0.0) spreads.table_sd_ratio = figure(table.exit_speed_se_ratio);
  if (direction.sd_rad.value > 0.0) {
    changed(key + "kicker.spreads.direction_sd_deg", degrees(spreads.direction_sd_rad), degrees(direction.sd_rad.value),
            certainty(degrees(direction.sd_rad.se), kicks));
    spreads.direction_sd_rad = figure_deg(direction.sd_rad.value);
  }
  robot_.kinds.at(kind - 1).source =
      fmt::format("{} on {}: table, delay and spreads of {} kicks ({}); the angle was not measured", tool_, date_,
                  kicks, fmt::join(files, ", "));
}

void RobotUpdate::set_play(const kicking::KickerEstimate& estimate, const std::vector<std::string>& files) {
  const kicking::RobotModel before = robot_.model;
  kicking::RobotModel& model = robot_.model;
  model = kicking::corrected(before, estimate);
  std::vector<kicking::SetPoint> points(model.table.set_points().begin(), model.table.set_points().end());
  for (kicking::SetPoint& point : points) point.speed_mps = figure(point.speed_mps);
  set_speeds(points, kicking::TableKind::kEffective);
  const kicking::KickerVector& se = estimate.se;
  const auto set = [&](const char* key, double kicking::RobotModel::*figure_of, double unit, double error_of) {
    model.*figure_of = figure(model.*figure_of / unit) * unit;
    changed(fmt::format("kicker.{}", key), before.*figure_of / unit, model.*figure_of / unit,
            certainty(error_of / unit, estimate.kicks));
  };
  const double degree = kicking::radians(1.0);
  changes_.push_back(fmt::format("table: exit speeds times {:.4f} ({})", std::exp(estimate.mean[kicking::kSpeedPart]),
                                 certainty(se[kicking::kSpeedPart], estimate.kicks)));
  set("exit_angle_deg", &kicking::RobotModel::exit_angle_rad, degree, se[kicking::kElevationPart]);
  set("direction_deg", &kicking::RobotModel::direction_rad, degree, se[kicking::kDirectionPart]);
  set("delay_s", &kicking::RobotModel::delay_s, 1.0, se[kicking::kDelayPart]);
  const double middle_mps = 0.5 * (model.table.front().speed_mps + model.table.back().speed_mps);
  set("alpha_slope_deg_per_mps", &kicking::RobotModel::alpha_slope_rad_per_mps, degree,
      se[kicking::kSidewaysPart] / (middle_mps * std::cos(model.exit_angle_rad)));
  set("beta_slope_s", &kicking::RobotModel::beta_slope_s, 1.0, se[kicking::kDelayPart]);
  const auto share = [&](const char* key, double kicking::Transfer::*of, double error_of) {
    model.transfer_exact.*of = figure(model.transfer_exact.*of);
    model.transfer_paper.*of = figure(model.transfer_paper.*of);
    changed(fmt::format("kicker.transfer_exact.{}", key), before.transfer_exact.*of, model.transfer_exact.*of,
            certainty(error_of, estimate.kicks));
  };
  share("forward_ratio", &kicking::Transfer::forward, se[kicking::kAlongPart]);
  share("backward_ratio", &kicking::Transfer::backward, se[kicking::kAlongPart]);
  share("lateral_ratio", &kicking::Transfer::lateral, se[kicking::kSidewaysPart]);
  kicking::KickSpreads& spreads = model.spreads;
  for (double* const ratio : {&spreads.speed_sd_ratio, &spreads.table_sd_ratio, &spreads.transfer_sd_ratio})
    *ratio = figure(*ratio);
  spreads.exit_angle_sd_rad = figure_deg(estimate.elevation_sd_rad);
  spreads.direction_sd_rad = figure_deg(estimate.direction_sd_rad);
  spreads.delay_sd_s = figure(estimate.delay_sd_s);
  spreads.exit_angle_se_rad = figure_deg(se[kicking::kElevationPart]);
  spreads.direction_se_rad = figure_deg(se[kicking::kDirectionPart]);
  spreads.delay_se_s = figure(se[kicking::kDelayPart]);
  calibration().play = play_origin(origin(estimate.kicks, files), se);
}

std::string RobotUpdate::text() const {
  config::Robot robot = robot_;
  std::string head = fmt::format("# Robot {}, written by {} on {}.\n", robot.name, tool_, date_);
  if (robot.calibration) {
    config::Calibration& calibration = *robot.calibration;
    calibration.source = tool_;
    calibration.date = date_;
    calibration.kicks = kicks_behind(calibration);
    head += fmt::format("# Measured: {}.\n# Not measured, kept as they were: {}.\n",
                        fmt::join(measured(calibration), ", "), fmt::join(not_measured(calibration), ", "));
  }
  return head + config::to_toml_text(robot);
}

void RobotUpdate::write(const std::filesystem::path& path) const {
  const std::string what = "the robot's file";
  evaluator::replace_file(path, text(), what, [&](const std::filesystem::path& beside) {
    try {
      config::load_robot_of_any_table(beside);
    } catch (const config::Error& error) {
      const std::string why = error.what();
      throw std::runtime_error(fmt::format("cannot write {} {}: a figure is impossible{}", what, path.string(),
                                           why.substr(beside.string().size())));
    }
  });
}

}  // namespace trivela::calibration
