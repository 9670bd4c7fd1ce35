#include "kicking/lob/fit/flight_model.hpp"

#include "kicking/ballistics/flight.hpp"

namespace trivela::kicking::lob {

FlightModel::FlightModel(std::span<const BallCentre> centres, double launch_z_m, const AnalyzerConfig& config, int free)
    : centres_(centres),
      launch_z_m_(launch_z_m),
      free_(free),
      k_per_cd_(drag_per_m(config.ball, {.density_kgpm3 = config.air_density_kgpm3, .drag_coefficient = 1.0})) {}

void FlightModel::fly(const Parameters& p, std::vector<Eigen::Vector4d>& states, double lift_coefficient) {
  times_s_.clear();
  for (std::size_t i = 0; i < size(); ++i) times_s_.push_back(t_s(i) - p[1]);
  fly_at_times({p[0], launch_z_m_, p[2], p[3]}, k_per_cd_ * p[4], times_s_, states, k_per_cd_ * lift_coefficient);
}

void FlightModel::errors(const Parameters& p, std::vector<Eigen::Vector2d>& errors_m) {
  fly(p, states_);
  errors_m.clear();
  for (std::size_t i = 0; i < size(); ++i)
    errors_m.emplace_back(centres_[i].x_m - states_[i][0], centres_[i].z_m - states_[i][1]);
}

std::vector<Eigen::Vector2d> FlightModel::by_lift(const Parameters& p) {
  constexpr double kDifference = 1e-4;
  fly(p, states_);
  fly(p, moved_states_, kDifference);
  std::vector<Eigen::Vector2d> result;
  for (std::size_t i = 0; i < size(); ++i) result.push_back((moved_states_[i] - states_[i]).head<2>() / kDifference);
  return result;
}

void FlightModel::jacobians(const Parameters& p, std::vector<Jacobian>& result) {
  constexpr double kDifference = 1e-5;
  fly(p, states_);
  result.assign(size(), Jacobian::Zero());
  for (std::size_t i = 0; i < size(); ++i) {
    result[i].col(0) << 1.0, 0.0;
    result[i].col(1) = -states_[i].tail<2>();
  }
  for (int column = 2; column < free_; ++column) {
    Parameters moved = p;
    moved[column] += kDifference;
    fly(moved, moved_states_);
    for (std::size_t i = 0; i < size(); ++i)
      result[i].col(column) = (moved_states_[i] - states_[i]).head<2>() / kDifference;
  }
}

}  // namespace trivela::kicking::lob
