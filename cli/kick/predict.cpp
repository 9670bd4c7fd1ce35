#include "cli/kick/row_verbs.hpp"
#include "evaluator/timeline/kick_picture.hpp"

namespace trivela::cli {
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
