#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "kicking/geometry/time.hpp"
#include "kicking/lob/analyzer_config.hpp"
#include "kicking/lob/lob_record.hpp"

namespace trivela::kicking::lob {

/// Where a flight with given parameters is at the instants of centres, and how that changes with the parameters.
class FlightModel {
 public:
  using Parameters = Eigen::Matrix<double, 5, 1>;  ///< x and t of the launch [m, s], v_x, v_z [m/s], C_d
  using Covariance = Eigen::Matrix<double, 5, 5>;
  using Jacobian = Eigen::Matrix<double, 2, 5>;  ///< d(x, z)/d(parameters)

  /// t is counted from the first centre. `free`: 5, or 4 if C_d is given. `centres` must outlive the model.
  FlightModel(std::span<const BallCentre> centres, double launch_z_m, const AnalyzerConfig& config, int free);

  std::size_t size() const { return centres_.size(); }
  int free() const { return free_; }
  double t_s(std::size_t i) const { return seconds(centres_[i].t_ns - centres_[0].t_ns); }

  /// Centre minus flight at each instant [m].
  void errors(const Parameters& p, std::vector<Eigen::Vector2d>& errors_m);

  /// d(x, z)/d(C_L) of a flight without lift, one entry a centre; C_L is to lift what C_d is to drag.
  std::vector<Eigen::Vector2d> by_lift(const Parameters& p);

  /// 1 by x, minus the velocity by t, differences by the others.
  void jacobians(const Parameters& p, std::vector<Jacobian>& result);

 private:
  void fly(const Parameters& p, std::vector<Eigen::Vector4d>& states, double lift_coefficient = 0.0);

  std::span<const BallCentre> centres_;
  double launch_z_m_;
  int free_;
  double k_per_cd_;
  std::vector<double> times_s_;
  std::vector<Eigen::Vector4d> states_, moved_states_;
};

}  // namespace trivela::kicking::lob
