#include "cli/calibrate/asked_drives.hpp"

#include <fmt/format.h>

#include "cli/calibrate/drive_match.hpp"
#include "cli/options/output.hpp"
#include "config/text/csv_row.hpp"
#include "config/text/parse_number.hpp"

namespace trivela::cli {
namespace {

std::string answer_to(Person& person, const std::string& question, const calibration::CalibrationRecord& kept) {
  const auto said = person.ask(question);
  std::string answer = said ? config::trimmed(*said) : "q";
  if (answer == "q" || answer == "Q" || answer == "quit")
    throw LeftForToday{
        fmt::format("left for today; the same command goes on from here, with {}", kept.folder().string())};
  return answer;
}

/// Whoever types anything else did not mean to start a robot.
void wait_for_enter(Person& person, const calibration::CalibrationRecord& kept) {
  for (;;) {
    const std::string answer = answer_to(person, "Enter: begin; q: leave for today: ", kept);
    if (answer.empty()) return;
    say(fmt::format("'{}' begins nothing.\n", answer));
  }
}

}  // namespace

double ask_for(const calibration::FieldMeasure& measure, double proposed, calibration::CalibrationRecord& kept,
               Person& person) {
  if (const auto known = kept.measured(measure.name)) {
    say(fmt::format("{}: {:.3f} (measured before)\n", measure.question, *known));
    return *known;
  }
  for (;;) {
    const std::string answer = answer_to(person, fmt::format("{} [{:.3f}]: ", measure.question, proposed), kept);
    const auto value = answer.empty() ? std::optional{proposed} : config::parse_number(answer);
    if (value && *value >= measure.least_m && *value <= measure.most_m) {
      kept.measure(measure.name, *value);
      return *value;
    }
    say(fmt::format("'{}' is no length from {:.1f} to {:.1f} m.\n", answer, measure.least_m, measure.most_m));
  }
}

calibration::DriveRecord AskedDrives::play(const calibration::DrivePlan& plan, const calibration::RobotUpdate& robot) {
  if (kept_.finished(plan.name)) {
    say(fmt::format("{}: played before, from its records\n", plan.name));
    calibration::DriveRecord record = drive_files(kept_.folder(), plan);
    read_back(record);
    return record;
  }
  if (calibration::set_aside(kept_.folder(), plan.name) > 0)
    say(fmt::format("{}: what was recorded of an earlier start is kept as {}.partial-*\n", plan.name, plan.name));
  say(fmt::format("\n{}\n{}", plan.name, calibration::instructions(plan, settings_)));
  wait_for_enter(person_, kept_);
  calibration::DriveRecord record = played_by_.play(plan, robot);
  kept_.finish(plan.name);
  return record;
}

}  // namespace trivela::cli
