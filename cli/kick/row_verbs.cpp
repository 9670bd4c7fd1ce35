#include "cli/kick/row_verbs.hpp"

#include "config/robot.hpp"
#include "evaluator/timeline/kick_picture.hpp"
#include "kicking/alignment/alignment.hpp"
#include "kicking/ballistics/flight.hpp"
#include "kicking/ballistics/moving_kick.hpp"

namespace trivela::cli {
namespace {

const char* name(kicking::PowerRange range) {
  return range == kicking::PowerRange::kBelow ? "below" : range == kicking::PowerRange::kIn ? "in" : "above";
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

namespace {

kicking::Extension extension(const Row& row) {
  const std::string rule = row.word("rule").value_or("max");
  if (rule == "max") return kicking::Extension::kMax;
  if (rule == "add") return kicking::Extension::kAdd;
  throw CellError("rule", rule, "is neither max nor add");
}

int run_align(const RowArguments& arguments) { return run_row_verb(align_verb(), arguments); }

}  // namespace

RowVerb align_verb() {
  RowVerb verb;
  verb.inputs = {{"px", "Robot in the field frame, x [m]", true, "--px-m"},
                 {"py", "Robot in the field frame, y [m]", true, "--py-m"},
                 {"orientation_deg", "Heading, counter-clockwise, 0 faces +y [deg]"},
                 {"alpha_deg", "Deflection by the lateral velocity, right positive [deg]"},
                 {"tx", "Target in the field frame, x [m]", true, "--tx-m"},
                 {"ty", "Target in the field frame, y [m]", true, "--ty-m"},
                 {"beta_deg", "Lead angle of the rotation [deg]"},
                 {"omega_rad_s", "Turn rate, counter-clockwise positive [rad/s]", true, "--omega-radps"},
                 {"rule", "Extension of the target's segment: max (default) or add", false}};
  verb.results = [](const auto&) {
    return std::vector<std::string>{"distance_m", "offset_right_m", "left_m", "right_m", "aligned"};
  };
  verb.compute = [](const Row& row) {
    const kicking::Pose robot{row.number("px"), row.number("py"), kicking::radians(row.number("orientation_deg"))};
    const Eigen::Vector2d target(row.number("tx"), row.number("ty"));
    kicking::AlignmentRule rule;
    rule.extension = extension(row);
    const auto result = kicking::align(robot, kicking::radians(row.number_in("alpha_deg", -180.0, 180.0)),
                                       kicking::radians(row.number_in("beta_deg", -360.0, 360.0)),
                                       row.number("omega_rad_s"), target, rule);
    return std::vector<Value>{result.centre_distance_m, value_or_none(result.offset_right_m), result.left_m,
                              result.right_m, result.aligned};
  };
  return verb;
}

void add_align(CLI::App& app, int& exit_code) {
  const auto [verb, arguments] = add_verb(app, exit_code, "align", "Is the robot aligned with the target?", run_align);
  verb->footer(
      R"(Appends distance_m, offset_right_m (empty: the line of the kick does not meet that of the target), left_m,
right_m and aligned. Columns px, py, tx, ty are in m.)");
  add_row_flags(*verb, align_verb(), *arguments);
}

namespace {

evaluator::KickPicture picture_of(const Row& row, const FlightConstants& constants) {
  const kicking::Pose pose{row.number("px"), row.number("py"), row.number("orientation_rad")};
  const kicking::Twist twist{row.number("vx"), row.number("vy"), row.number("omega")};
  const double k = row.number_in("k", 0.0, 10.0);
  evaluator::KickPicture picture{.robot = pose,
                                 .twist = twist,
                                 .kick = {.v_kick_mps = row.positive("vk"),
                                          .exit_angle = row.acute_angle_rad("theta_deg"),
                                          .transfer = {k, k, k},
                                          .delay_s = row.number_in("tau_s", 0.0, 10.0),
                                          .ball_offset_m = row.number_in("r_m", 0.0, 10.0)},
                                 .goal = {.y_m = row.number("goal_y")},
                                 .ball = constants.ball,
                                 .gravity_mps2 = constants.gravity_mps2};
  if (picture.goal.y_m == 11.0) {  // the 22 x 14 m field
    picture.goal.half_width_m = 1.2;
    picture.side_line_x_m = 7.0;
  }
  return picture;
}

struct PredictArguments {
  RowArguments rows;
  FlightConstants constants;
};

int run_predict(const PredictArguments& arguments) {
  return run_row_verb(predict_verb(arguments.constants), arguments.rows);
}

}  // namespace

RowVerb predict_verb(const FlightConstants& constants) {
  RowVerb verb;
  verb.inputs = {{"px", "Robot in the field frame, x [m]", true, "--px-m"},
                 {"py", "Robot in the field frame, y [m]", true, "--py-m"},
                 {"orientation_rad", "Heading, counter-clockwise, 0 faces +y [rad]"},
                 {"vx", "Robot's velocity to its right [m/s]", true, "--vx-mps"},
                 {"vy", "Robot's velocity forward [m/s]", true, "--vy-mps"},
                 {"omega", "Turn rate, counter-clockwise positive [rad/s]", true, "--omega-radps"},
                 {"tau_s", "From the order to the release [s]"},
                 {"r_m", "Robot centre to ball centre [m]"},
                 {"vk", "Exit speed of the kick [m/s]", true, "--vk-mps"},
                 {"theta_deg", "Exit angle over the floor [deg]"},
                 {"k", "Share of the robot's velocity that the ball takes over"},
                 {"goal_y", "Goal line in the field frame, y [m]", true, "--goal-y-m"}};
  verb.results = [](const auto&) { return std::vector<std::string>{"x_cross_m", "z_cross_m", "t_flight_s"}; };
  verb.compute = [constants](const Row& row) {
    const evaluator::KickPicture kick = picture_of(row, constants);
    const auto crossing = kicking::predict_crossing(kick.robot, kick.twist, kick.kick, kick.goal.y_m,
                                                    kick.ball.radius_m, kick.gravity_mps2);
    if (!crossing) return std::vector<Value>(3);
    return std::vector<Value>{crossing->x_m, crossing->z_m, crossing->t_flight_s};
  };
  verb.draw = [constants](const Row& row) { return evaluator::to_svg(picture_of(row, constants)); };
  return verb;
}

void add_predict(CLI::App& app, int& exit_code) {
  const auto [verb, arguments] = add_verb(
      app, exit_code, "predict", "Where the ball crosses the goal line if the order goes out now", run_predict);
  verb->footer(
      R"(Appends x_cross_m, z_cross_m and t_flight_s, empty where the ball never crosses. Free flight without drag; a
negative z_cross_m: it would have touched the floor before the line. Columns px, py, goal_y are in m, vx, vy, vk
in m/s, omega in rad/s.)");
  add_row_flags(*verb, predict_verb({}), arguments->rows);
  add_flight_flags(*verb, arguments->constants);
}

}  // namespace trivela::cli
