#include "config/kicker_state.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <string>
#include <system_error>

#include "config/text/toml_source.hpp"
#include "config/text/toml_text.hpp"

namespace trivela::config {
namespace {

using Clock = std::chrono::system_clock;

/// The file as it is written: whose estimate it is, when, what it is added to, and the estimate.
struct StateFile {
  std::string robot;
  std::uint32_t robot_id = 0;
  double utc_s = 0.0;  ///< since 1970
  std::vector<double> exit_speeds_mps;
  double exit_angle_deg = 0.0;
  double delay_s = 0.0;
  std::vector<double> means;
  std::vector<double> standard_errors;
  kicking::KickerEstimate estimate{};  ///< spreads and kicks
};

void fields(auto& v, StateFile& f) {
  v("robot", f.robot);
  v("robot_id", f.robot_id);
  v("utc_s", f.utc_s);
  v("exit_speeds_mps", f.exit_speeds_mps);
  v("exit_angle_deg", f.exit_angle_deg);
  v("delay_s", f.delay_s);
  v("means", f.means);
  v("standard_errors", f.standard_errors);
  v("speed_sd_ratio", f.estimate.speed_sd_ratio);
  v("elevation_sd_deg", Degrees{f.estimate.elevation_sd_rad});
  v("direction_sd_deg", Degrees{f.estimate.direction_sd_rad});
  v("delay_sd_s", f.estimate.delay_sd_s);
  v("kicks", f.estimate.kicks);
}

double seconds_of(Clock::time_point now) { return std::chrono::duration<double>(now.time_since_epoch()).count(); }

/// What the estimate is added to.
StateFile state_of(const Robot& robot, std::uint32_t robot_id) {
  StateFile state;
  state.robot = robot.name;
  state.robot_id = robot_id;
  for (const kicking::SetPoint& point : robot.model.table.set_points())
    state.exit_speeds_mps.push_back(point.speed_mps);
  state.exit_angle_deg = kicking::degrees(robot.model.exit_angle_rad);
  state.delay_s = robot.model.delay_s;
  return state;
}

bool same_file(const StateFile& a, const StateFile& b) {
  constexpr double kRounded = 1e-9;
  return a.exit_speeds_mps == b.exit_speeds_mps && std::abs(a.exit_angle_deg - b.exit_angle_deg) < kRounded &&
         a.delay_s == b.delay_s;
}

}  // namespace

std::optional<kicking::KickerEstimate> load_kicker_state(const std::filesystem::path& path, const Robot& robot,
                                                         std::uint32_t robot_id, double max_age_h,
                                                         Clock::time_point now) {
  std::error_code none;
  if (!std::filesystem::exists(path, none)) return std::nullopt;
  const TomlSource source = parse_file(path);
  StateFile state;
  read_into(source, state);
  const StateFile own = state_of(robot, robot_id);
  const auto refuse = [&](const std::string& why) { throw Error{fmt::format("{}: {}", path.string(), why)}; };
  if (state.robot != own.robot || state.robot_id != robot_id)
    refuse(fmt::format("is of robot {} ({}), and this is robot {} ({})", state.robot_id, state.robot, robot_id,
                       own.robot));
  if (!same_file(state, own)) refuse("was learned with another file of the robot: table, exit angle or delay differ");
  const double age_h = (seconds_of(now) - state.utc_s) / 3600.0;
  if (age_h < -0.1) refuse(fmt::format("is of {:.1f} h from now: is the clock set?", -age_h));
  if (age_h > max_age_h)
    refuse(fmt::format("is {:.1f} h old, and self_calibration.state_max_age_h = {:g}", age_h, max_age_h));
  constexpr auto kParts = static_cast<std::size_t>(kicking::kKickerParts);
  if (state.means.size() != kParts || state.standard_errors.size() != kParts)
    refuse(fmt::format("means and standard_errors need {} numbers each", kParts));
  for (std::size_t i = 0; i < kParts; ++i) {
    state.estimate.mean[static_cast<Eigen::Index>(i)] = state.means[i];
    state.estimate.se[static_cast<Eigen::Index>(i)] = state.standard_errors[i];
  }
  if (!kicking::valid(state.estimate)) refuse("has numbers that no kicker has");
  return state.estimate;
}

void save_kicker_state(const std::filesystem::path& path, const kicking::KickerEstimate& estimate, const Robot& robot,
                       std::uint32_t robot_id, Clock::time_point now) {
  StateFile state = state_of(robot, robot_id);
  state.utc_s = seconds_of(now);
  state.means.assign(estimate.mean.begin(), estimate.mean.end());
  state.standard_errors.assign(estimate.se.begin(), estimate.se.end());
  state.estimate = estimate;
  const std::filesystem::path beside = path.string() + ".new";
  {
    std::ofstream file(beside, std::ios::trunc);
    file << "# What the kicks have shown of a robot's kicker: to be added to its file. Written by "
            "trivela-shot_observer.\n"
         << to_toml(state);
    file.flush();
    if (!file) throw Error{fmt::format("cannot write {}", beside.string())};
  }
  std::error_code failed;
  std::filesystem::rename(beside, path, failed);
  if (failed) throw Error{fmt::format("cannot write {}: {}", path.string(), failed.message())};
}

std::filesystem::path set_kicker_state_aside(const std::filesystem::path& path) {
  std::filesystem::path aside = path.string() + ".refused";
  for (int n = 2; std::filesystem::exists(aside); ++n) aside = fmt::format("{}.refused-{}", path.string(), n);
  std::error_code wrong;
  std::filesystem::rename(path, aside, wrong);
  if (wrong)
    throw Error{fmt::format("{}: cannot be renamed to {}: {}", path.string(), aside.string(), wrong.message())};
  return aside;
}

}  // namespace trivela::config
