// Shall this robot kick now, and how hard?
#include <cstdio>
#include <trivela/kicking.hpp>

int main() {
  const trivela::RobotModel robot;       // CAMBADA's number 1, as published
  const trivela::Goal goal{.y_m = 9.0};  // of a field of 18 m
  trivela::State state;
  state.pose = {.x_m = 0.5, .y_m = 4.0, .heading_rad = 0.1};
  state.twist = {.vx_mps = 0.0, .vy_mps = 1.0, .omega_radps = 0.0};
  state.playing = state.possession = state.kicker_ready = true;

  const trivela::PolicyOutput output = trivela::evaluate(robot, goal, state);

  std::printf("%s: %s, %.2f m from the target\n", output.fire ? "fire" : "hold", name(output.reason),
              output.distance_m);
  if (output.power) std::printf("power %.3f for %.3f m/s\n", *output.power, *output.v_kick_mps);
  if (output.predicted)  // it lands on the line: by default heights are by the paper's law
    std::printf("crosses the goal line at x = %.3f m, z = %.3f m\n", output.predicted->x_m, output.predicted->z_m);
}
