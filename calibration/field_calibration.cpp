#include "calibration/field_calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include "config/text/error.hpp"
#include "config/text/open_file.hpp"
#include "evaluator/render/json_values.hpp"
#include "evaluator/render/write_file.hpp"
#include "log/read/reader.hpp"

namespace trivela::calibration {

namespace fs = std::filesystem;

namespace {

bool is_whole_log(const fs::path& file) {
  try {
    const auto sessions = log::Reader{file}.sessions();
    return !sessions.empty() && std::ranges::all_of(sessions, [](const auto& s) { return s.closed_t_ns.has_value(); });
  } catch (const std::exception&) {
    return false;
  }
}

/// Drives whose logs were closed; scans (NAME.scans.db) and what was set aside have a dot in their names.
std::set<std::string> played_in(const fs::path& folder) {
  std::set<std::string> drives;
  for (const auto& entry : fs::directory_iterator{folder}) {
    const fs::path& file = entry.path();
    const std::string drive = file.stem().string();
    if (file.extension() == ".db" && drive.find('.') == std::string::npos && is_whole_log(file)) drives.insert(drive);
  }
  return drives;
}

}  // namespace

CalibrationRecord::CalibrationRecord(fs::path folder, std::string arguments)
    : folder_(std::move(folder)), file_(folder_ / "calibration.json"), arguments_(std::move(arguments)) {
  fs::exists(file_) ? read() : write();
}

void CalibrationRecord::read() {
  std::string begun_with;
  try {
    const auto json = evaluator::Json::parse(config::read_text_file(file_));
    begun_with = json.at("arguments").get<std::string>();
    for (const auto& [what, value] : json.at("measured").items()) measured_[what] = value.get<double>();
    finished_ = json.at("finished").get<std::set<std::string>>();
  } catch (const evaluator::Json::exception&) {
    throw std::runtime_error{fmt::format(
        "{} is cut short, or no record of a calibration. Its drives are not lost: to go on with those whose "
        "logs are whole beside it, write this into it (what was measured is asked again):\n{}",
        file_.string(), text_with(played_in(folder_)))};
  }
  if (begun_with == arguments_) return;
  throw config::BadArgument{
      fmt::format("{} was begun with '{}', not with '{}': take another --out-dir for another calibration",
                  file_.string(), begun_with, arguments_)};
}

std::string CalibrationRecord::text_with(const std::set<std::string>& finished) const {
  return evaluator::json_text(
      evaluator::Json{{"arguments", arguments_}, {"measured", measured_}, {"finished", finished}});
}

void CalibrationRecord::write() const {
  evaluator::replace_file(file_, text_with(finished_), "the calibration's record");
}

std::optional<double> CalibrationRecord::measured(const std::string& what) const {
  const auto found = measured_.find(what);
  return found == measured_.end() ? std::nullopt : std::optional{found->second};
}

void CalibrationRecord::measure(const std::string& what, double value) {
  measured_[what] = value;
  write();
}

void CalibrationRecord::finish(const std::string& drive) {
  finished_.insert(drive);
  write();
}

std::size_t set_aside(const fs::path& folder, const std::string& drive) {
  const std::string partial = drive + ".partial-";
  std::vector<std::string> endings;
  std::set<std::string> kept;
  for (const auto& entry : fs::directory_iterator{folder}) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(partial))
      kept.insert(name.substr(partial.size(), name.find('.', partial.size()) - partial.size()));
    else if (name.starts_with(drive + "."))
      endings.push_back(name.substr(drive.size()));
  }
  int n = 1;
  while (kept.contains(std::to_string(n))) ++n;
  for (const std::string& ending : endings)
    fs::rename(folder / (drive + ending), folder / fmt::format("{}{}{}", partial, n, ending));
  return endings.size();
}

namespace {

using kicking::PolicyName;

std::string placing(const DrivePlan& plan, const config::Settings& settings) {
  const auto& drive = settings.policy.test_drive;
  const double ball_m = plan.ball_to_goal_m.value_or(0.0);
  switch (plan.policy) {
    case PolicyName::kStandingDrive:
      if (!plan.laser) {
        return fmt::format(
            "The lever moves: keep hands out of the kicker. Lay the ball {:.2f} m from the goal line and the robot\n"
            "behind it, facing the goal. Its kicks stay low. Put both back there after each kick.",
            ball_m);
      }
      return fmt::format(
          "Lay the ball {:.2f} m from the goal line, in the scanner's plane, and the robot behind it, facing the "
          "goal.\n"
          "Put both back there after each kick.",
          ball_m);
    case PolicyName::kLateralDrive:
      return fmt::format(
          "The robot passes sideways {:.2f} m from the goal line: keep some metres free to both sides of the goal's "
          "axis.\n"
          "Give it the ball there; it drives to its marks by itself.",
          drive.distance_m);
    case PolicyName::kTurnDrive:
      return fmt::format(
          "Put the robot {:.2f} m from the goal line, in front of the goal's middle, with the ball. It turns on the "
          "spot.",
          ball_m);
    case PolicyName::kStraightDrive:
      return fmt::format(
          "The robot drives at the goal and away from it and kicks {:.2f} m from the line: keep its axis free, {:.1f} "
          "m\n"
          "before and behind that place. Give it the ball there.",
          drive.straight_distance_m, drive.run_up_m);
    default:
      return "The check: give the robot the ball anywhere from 3 to 8 m from the goal line; it stops, aims and kicks.";
  }
}

}  // namespace

FieldMeasure standing_distance() { return {"standing_to_goal_m", "Standing kicks: ball to goal line, m", 2.0, 12.0}; }

FieldMeasure laser_ahead() {
  return {"laser_x_m", "Scanner from the ball, along the kick (negative: behind it), m", -5.0, 20.0};
}

FieldMeasure laser_height() { return {"laser_z_m", "Scanner over the floor, m", 0.0, 2.0}; }

std::string instructions(const DrivePlan& plan, const config::Settings& settings) {
  return fmt::format("{}\n{} kicks{}. After each: the ball back into the handler, everybody out of the way.\n",
                     placing(plan, settings), plan.possessions, plan.laser ? " over the scanner" : "");
}

}  // namespace trivela::calibration
