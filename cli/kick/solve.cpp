#include "cli/kick/row_verbs.hpp"
#include "config/robot.hpp"
#include "evaluator/timeline/kick_picture.hpp"
#include "kicking/ballistics/drag.hpp"
#include "kicking/ballistics/kick_speeds.hpp"

namespace trivela::cli {
namespace {

const char* name(kicking::PowerRange range) {
  switch (range) {
    case kicking::PowerRange::kBelow:
      return "below";
    case kicking::PowerRange::kIn:
      return "in";
    case kicking::PowerRange::kAbove:
      break;
  }
  return "above";
}

Value drag_speed(const Row& row, const kicking::FlightPoint& point, double angle_rad,
                 const FlightConstants& constants) {
  if (!row.word("Cd")) return {};
  kicking::Air air = constants.air;
  air.drag_coefficient = row.number_in("Cd", 0.0, 10.0);
  return value_or_none(kicking::crossing_speed_with_drag(point, angle_rad, kicking::drag_per_m(constants.ball, air),
                                                         constants.gravity_mps2));
}

kicking::WantedKick wanted(const Row& row, const FlightConstants& constants) {
  return {.point = {row.positive("d_m"), row.number("h_rel_m")},
          .exit_angle = row.acute_angle_rad("theta_deg"),
          .v_front_mps = row.number_if_any("v_front_mps").value_or(0.0),
          .transfer = row.word("k_transfer") ? row.number_in("k_transfer", 0.0, 10.0) : 1.0,
          .gravity_mps2 = constants.gravity_mps2};
}

/// The robot faces the goal's middle; the ball leaves at once.
std::string draw(const Row& row, const FlightConstants& constants) {
  const kicking::WantedKick want = wanted(row, constants);
  const kicking::OptionalDouble vk = kicking::kick_speeds(want).vk_exact_mps;
  if (!vk) throw std::runtime_error("--svg: no speed solves this kick, there is nothing to draw");
  evaluator::KickPicture picture{.twist = {0.0, want.v_front_mps, 0.0},
                                 .kick = {.v_kick_mps = *vk,
                                          .exit_angle = want.exit_angle,
                                          .transfer = {want.transfer, want.transfer, want.transfer}},
                                 .ball = constants.ball,
                                 .gravity_mps2 = constants.gravity_mps2};
  picture.robot.y_m = picture.goal.y_m - want.point.distance_m - picture.kick.ball_offset_m;
  return evaluator::to_svg(picture);
}

struct SolveArguments {
  RowArguments rows;
  FlightConstants constants;
  std::string robot_file;
};

int run_solve(const SolveArguments& arguments) {
  std::optional<kicking::EffectiveTable> table;
  if (!arguments.robot_file.empty()) table = config::load_robot(arguments.robot_file).model.table;
  return run_row_verb(solve_verb(arguments.constants, table), arguments.rows);
}

}  // namespace

RowVerb solve_verb(const FlightConstants& constants, const std::optional<kicking::EffectiveTable>& table) {
  RowVerb verb;
  verb.inputs = {{"theta_deg", "Exit angle over the floor [deg]"},
                 {"d_m", "Ball centre to goal line, horizontal [m]"},
                 {"h_rel_m", "Wanted height over the launch, of the ball's centre [m]"},
                 {"v_front_mps", "Forward speed of the robot [m/s], default 0", false},
                 {"k_transfer", "Share of it that the ball takes over, default 1", false},
                 {"Cd", "Drag coefficient; adds v0_drag_mps", false, "--cd"}};
  verb.results = [with_power = table.has_value()](const auto& has) {
    std::vector<std::string> columns{"v0_mps", "vk_exact_mps", "vk_paper_mps", "feasible", "descending"};
    if (has("Cd")) columns.emplace_back("v0_drag_mps");
    if (with_power) columns.insert(columns.end(), {"power", "power_range"});
    return columns;
  };
  verb.compute = [constants, table](const Row& row) {
    const kicking::WantedKick want = wanted(row, constants);
    const kicking::KickSpeeds speeds = kicking::kick_speeds(want);
    std::vector<Value> values{value_or_none(speeds.v0_mps), value_or_none(speeds.vk_exact_mps),
                              value_or_none(speeds.vk_paper_mps), speeds.v0_mps.has_value()};
    values.push_back(speeds.v0_mps ? Value(speeds.descending) : Value());
    if (row.has("Cd")) values.push_back(drag_speed(row, want.point, want.exit_angle.angle_rad, constants));
    if (table) {
      const auto reading = speeds.vk_exact_mps ? std::optional(table->power_for(*speeds.vk_exact_mps)) : std::nullopt;
      values.push_back(reading ? Value(reading->power) : Value());
      values.push_back(reading ? Value(name(reading->range)) : Value());
    }
    return values;
  };
  verb.draw = [constants](const Row& row) { return draw(row, constants); };
  return verb;
}

void add_solve(CLI::App& app, int& exit_code) {
  const auto [verb, arguments] =
      add_verb(app, exit_code, "solve", "Exit speed and power for a height at a distance", run_solve);
  verb->footer(
      R"(Appends v0_mps (robot at rest), vk_exact_mps and vk_paper_mps (moving robot), feasible, descending; with Cd
v0_drag_mps; with --robot power and power_range (below, in or above the table) for vk_exact_mps.
Results of a row that no speed solves are empty. --svg draws vk_exact_mps, towards the middle of the goal.)");
  add_row_flags(*verb, solve_verb({}, {}), arguments->rows);
  add_flight_flags(*verb, arguments->constants);
  add_default(*verb, "--ball-mass-kg", arguments->constants.ball.mass_kg, "Mass of the ball", above_zero());
  add_default(*verb, "--air-density-kgpm3", arguments->constants.air.density_kgpm3, "Density of the air", above_zero());
  verb->add_option("--robot", arguments->robot_file, "Robot file whose table gives the power")->type_name("FILE");
}

}  // namespace trivela::cli
