#include "hal/refbox/worldstate.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace trivela::hal::refbox {
namespace {

using nlohmann::json;

json robot_object(const msg::WorldState& robot, const std::string& intention) {
  const double c = std::cos(robot.heading_rad), s = std::sin(robot.heading_rad);
  return {{"id", robot.robot_id},
          {"pose", {robot.x_m, robot.y_m, robot.heading_rad}},
          {"velocity", {c * robot.vx_mps - s * robot.vy_mps, s * robot.vx_mps + c * robot.vy_mps, robot.omega_radps}},
          {"intention", intention},
          {"ballEngaged", robot.possession ? 1 : 0}};
}

json ball_object(const msg::WorldState& robot) {
  return {{"position", {robot.ball_x_m, robot.ball_y_m, nullptr}},
          {"velocity", {robot.ball_vx_mps, robot.ball_vy_mps, nullptr}},
          {"confidence", std::clamp(1.0 - robot.ball_age_s, 0.0, 1.0)}};
}

}  // namespace

std::string worldstate_object(std::span<const msg::WorldState> robots, const TeamText& team, std::int64_t now_ns) {
  json object{{"type", "worldstate"},    {"teamName", team.name},  {"intention", team.intention}, {"ageMs", 0},
              {"robots", json::array()}, {"balls", json::array()}, {"obstacles", json::array()}};
  std::int64_t newest_ns = 0;
  for (const msg::WorldState& robot : robots) {
    newest_ns = std::max(newest_ns, robot.t_ns);
    object["robots"].push_back(robot_object(robot, team.intention));
    if (robot.ball_known && std::isfinite(robot.ball_age_s)) object["balls"].push_back(ball_object(robot));
  }
  if (!robots.empty()) object["ageMs"] = std::max<std::int64_t>(0, (now_ns - newest_ns) / 1'000'000);
  // A number that is not finite becomes null, a name that is no UTF-8 gets a mark for each such byte.
  return object.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace trivela::hal::refbox
