#include "kicking/lob/drag_path.hpp"

#include <cmath>

#include "kicking/constants.hpp"

namespace trivela::kicking::lob {
namespace {

constexpr double kLongestStep_s = 0.025;

using State = Eigen::Vector4d;

struct Forces {
  double drag_per_m;
  double lift_per_m;
};

State rate(const State& s, const Forces& air) {
  const double speed = std::hypot(s[2], s[3]), damping = air.drag_per_m * speed, turning = air.lift_per_m * speed;
  return {s[2], s[3], -damping * s[2] - turning * s[3], -kGravity_mps2 - damping * s[3] + turning * s[2]};
}

State fly(State s, const Forces& air, double duration_s) {
  const int steps = 1 + static_cast<int>(std::abs(duration_s) / kLongestStep_s);
  const double h = duration_s / steps;
  for (int i = 0; i < steps; ++i) {
    const State k1 = rate(s, air);
    const State k2 = rate(s + 0.5 * h * k1, air);
    const State k3 = rate(s + 0.5 * h * k2, air);
    const State k4 = rate(s + h * k3, air);
    s += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  return s;
}

}  // namespace

void fly_at_times(const Eigen::Vector4d& start, double drag_per_m, std::span<const double> times_s,
                  std::vector<Eigen::Vector4d>& states, double lift_per_m) {
  states.clear();
  State state = start;
  double t_s = 0.0;
  for (const double next_s : times_s) {
    state = fly(state, {drag_per_m, lift_per_m}, next_s - t_s);
    t_s = next_s;
    states.push_back(state);
  }
}

}  // namespace trivela::kicking::lob
