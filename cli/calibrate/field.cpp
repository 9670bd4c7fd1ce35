#include <fmt/format.h>

#include <memory>
#include <optional>

#include "calibration/drive_source.hpp"
#include "calibration/field_calibration.hpp"
#include "cli/calibrate/drive_match.hpp"
#include "cli/calibrate/robot_drives.hpp"
#include "cli/calibrate/robot_file.hpp"
#include "cli/calibrate/run.hpp"
#include "cli/launch/terminal.hpp"
#include "cli/options/match_mode.hpp"
#include "cli/options/output.hpp"
#include "cli/verbs.hpp"
#include "config/scenario/scenario.hpp"
#include "config/settings.hpp"
#include "config/text/csv_row.hpp"
#include "config/text/parse_number.hpp"
#include "experiment/calibration/simulated_calibration.hpp"

namespace trivela::cli {
namespace {

/// Somebody left for today: the same command goes on from here.
struct LeftForToday : std::runtime_error {
  using std::runtime_error::runtime_error;
};

std::string answer_to(Operator& user, const std::string& question, const calibration::CalibrationRecord& kept) {
  const auto said = user.ask(question);
  std::string answer = said ? config::trimmed(*said) : "q";
  if (answer == "q" || answer == "Q" || answer == "quit")
    throw LeftForToday{
        fmt::format("left for today; the same command goes on from here, with {}", kept.folder().string())};
  return answer;
}

/// Whoever types anything else did not mean to start a robot.
void wait_for_enter(Operator& user, const calibration::CalibrationRecord& kept) {
  for (;;) {
    const std::string answer = answer_to(user, "Enter: begin; q: leave for today: ", kept);
    if (answer.empty()) return;
    say(fmt::format("'{}' begins nothing.\n", answer));
  }
}

/// Asks for the length, proposing what is in the record, else `proposed`; keeps the answer. Throws LeftForToday.
double ask_for(const calibration::FieldMeasure& measure, double proposed, calibration::CalibrationRecord& kept,
               Operator& user) {
  if (const auto known = kept.measured(measure.name)) {
    say(fmt::format("{}: {:.3f} (measured before)\n", measure.question, *known));
    return *known;
  }
  for (;;) {
    const std::string answer = answer_to(user, fmt::format("{} [{:.3f}]: ", measure.question, proposed), kept);
    const auto value = answer.empty() ? std::optional{proposed} : config::parse_number(answer);
    if (value && *value >= measure.least_m && *value <= measure.most_m) {
      kept.measure(measure.name, *value);
      return *value;
    }
    say(fmt::format("'{}' is no length from {:.1f} to {:.1f} m.\n", answer, measure.least_m, measure.most_m));
  }
}

/// The drives of a calibration on a field: before each a person is told what to place and asked to go on, and each that
/// was played to its end is in the record. One that the record has is read from its records.
class AskedDrives : public calibration::DriveSource {
 public:
  /// All outlive it. `played_by`: plays what was confirmed.
  AskedDrives(calibration::DriveSource& played_by, const config::Settings& settings,
              calibration::CalibrationRecord& kept, Operator& user)
      : played_by_(played_by), settings_(settings), kept_(kept), user_(user) {}

  /// Throws LeftForToday, and what the source throws; then the records so far are set aside when it is played again.
  calibration::DriveRecord play(const calibration::DrivePlan& plan, const calibration::RobotUpdate& robot) override {
    if (kept_.finished(plan.name)) {
      say(fmt::format("{}: played before, from its records\n", plan.name));
      calibration::DriveRecord record = drive_files(kept_.folder(), plan);
      read_back(record);
      return record;
    }
    if (calibration::set_aside(kept_.folder(), plan.name) > 0)
      say(fmt::format("{}: what was recorded of an earlier start is kept as {}.partial-*\n", plan.name, plan.name));
    say(fmt::format("\n{}\n{}", plan.name, calibration::instructions(plan, settings_)));
    wait_for_enter(user_, kept_);
    calibration::DriveRecord record = played_by_.play(plan, robot);
    kept_.finish(plan.name);
    return record;
  }

 private:
  calibration::DriveSource& played_by_;
  const config::Settings& settings_;
  calibration::CalibrationRecord& kept_;
  Operator& user_;
};

namespace fs = std::filesystem;

/// Where the calibration takes place.
struct Field {
  config::Settings settings;
  std::optional<sim::Scenario> world;        ///< a rehearsal's
  std::optional<sim::Scenario> check_world;  ///< the same
};

Field field_of(const RunFlags& flags) {
  Field field{config::load_settings(flags.config), {}, {}};
  config::override_settings(field.settings, flags.overrides, "--set");
  field.settings.run.log_level = flags.log_level;
  if (!flags.rehearse) {
    refuse_in_a_match(field.settings, "the calibration on a field");
    field.settings = experiment::calibration_settings(std::move(field.settings));
    return field;
  }
  field.world = config::load_scenario(flags.scenario);
  field.check_world = config::load_scenario(flags.check);
  field.settings = experiment::calibration_settings(std::move(field.settings), *field.world);
  return field;
}

void refuse_flags_of_simulation(const RunFlags& flags) {
  if (flags.in_process) throw UsageError{"--in-process goes with --in simulation: a field has its nodes"};
  if (!flags.team.empty())
    throw UsageError{"--team goes with --in simulation: on a field the robot is as fast as it is"};
  if (flags.json) throw UsageError{"--json goes with --in simulation: on a field standard output is for questions"};
}

/// What a calibration must have been begun with to go on: the rest is of no consequence for its records.
std::string arguments_of(const RunFlags& flags, bool rehearsal) {
  return fmt::format("--in field{} --robot {} --seed {} --kicks {} --lobs {} --drive-kicks {} --turn-kicks {}",
                     rehearsal ? " (rehearsal)" : "", flags.robot, flags.seed, flags.effort.kicks, flags.effort.lobs,
                     flags.effort.drive_kicks, flags.effort.turn_kicks);
}

calibration::RobotUpdate robot_of(const RunFlags& flags, bool rehearsal) {
  config::Robot robot = config::load_robot(flags.start);
  robot.source = fmt::format("{}: trivela calibrate run --in field; what [calibration] does not name comes from: {}",
                             rehearsal ? "simulated" : "measured", robot.source);
  robot.name = flags.robot;
  robot.calibration.reset();
  return {robot, fmt::format("trivela calibrate run --in field --robot {}", flags.robot), today()};
}

std::unique_ptr<calibration::DriveSource> drives_in(const std::optional<sim::Scenario>& world,
                                                    const config::Settings& settings, const fs::path& folder,
                                                    const fs::path& part, SignalInbox& signals) {
  if (world) return std::make_unique<DriveMatches>(*world, settings, folder, part, signals);
  return std::make_unique<RobotDrives>(settings, folder, part, signals);
}

int play_in(Field field, const RunFlags& flags, const calibration::RobotUpdate& start, const fs::path& file,
            SignalInbox& signals) {
  const fs::path folder = fs::absolute(flags.out_dir);
  fs::path part = file;
  part += ".part";  // until every figure is in it
  calibration::CalibrationRecord kept{folder, arguments_of(flags, field.world.has_value())};
  Operator user{signals};
  config::Settings& settings = field.settings;
  const double standing_m = ask_for(calibration::standing_distance(),
                                    field.world ? field.world->possession.goal_distance_max_m : 6.0, kept, user);
  settings.scan_recorder.mount_x_m = ask_for(calibration::laser_ahead(), settings.scan_recorder.mount_x_m, kept, user);
  settings.scan_recorder.mount_z_m = ask_for(calibration::laser_height(), settings.scan_recorder.mount_z_m, kept, user);
  RunReport report{false};
  const auto played = drives_in(field.world, settings, folder, part, signals);
  AskedDrives asked{*played, settings, kept, user};
  calibration::CalibrationRun run{asked, standing_m, settings, flags.effort, flags.seed * 100, start};
  run.calibration([&](const calibration::DriveSummary& summary) {
    report.add(summary);
    std::fflush(stdout);
  });
  const auto checked_by = drives_in(field.check_world, settings, folder, part, signals);
  AskedDrives check{*checked_by, settings, kept, user};
  const calibration::DriveRecord checked = check.play(check_plan(flags, false), run.robot());
  run.robot().write(file);
  std::error_code none;
  fs::remove(part, none);
  const experiment::AimErrors observed = experiment::observed_errors(checked.kicks, settings);
  RunReport::finish(run.robot(), file.string(), observed);
  return passes_gate(observed) ? kDone : kDoneWithLoss;
}

}  // namespace

int calibrate_in_field(const RunFlags& flags) {
  refuse_flags_of_simulation(flags);
  Field field = field_of(flags);
  const calibration::RobotUpdate start = robot_of(flags, field.world.has_value());
  if (!Operator::is_there())
    throw std::runtime_error{"--in field asks a person for each step: standard input is no terminal"};
  const fs::path file = place_of(flags);
  SignalInbox signals;
  if (field.world) say("A REHEARSAL: the drives are played in the simulator's world.\n");
  try {
    return play_in(std::move(field), flags, start, file, signals);
  } catch (const LeftForToday& left) {
    say(fmt::format("{}\n", left.what()));
    return kFailed;
  }
}

}  // namespace trivela::cli
