#include "kicking/alignment/deflection.hpp"

#include <cmath>

namespace trivela::kicking {

double alpha_paper_rad(double vx_mps, double slope_rad_per_mps) { return slope_rad_per_mps * vx_mps; }

double alpha_atan_rad(double vx_mps, double distance_m, double time_s) {
  return std::atan(vx_mps * time_s / distance_m);
}

double alpha_physical_rad(double v_kick_mps, const Elevation& exit_angle, const Transfer& transfer, const Twist& twist,
                          double ball_offset_m) {
  return std::atan2(transfer.lateral * (twist.vx_mps - twist.omega_radps * ball_offset_m),
                    v_kick_mps * exit_angle.cosine + transfer.along_mps(twist.vy_mps));
}

double beta_paper_rad(double omega_radps, double slope_s) { return slope_s * omega_radps; }

double beta_physical_rad(double omega_radps, double delay_s, double ball_offset_m, double v_h_mps) {
  return omega_radps * delay_s + std::atan(omega_radps * ball_offset_m / v_h_mps);
}

}  // namespace trivela::kicking
