#pragma once

#include "kicking/lob/fit/flight_model.hpp"

namespace trivela::kicking::lob {

/// Minimises sum rho(|e_i|) over the free parameters, e_i the model's errors, by Levenberg-Marquardt with the weights
/// W = min(1, bend / |e_i|). rho is Huber's: e^2 / 2 up to the bend, bend (e - bend / 2) beyond. False: it does not
/// converge.
bool descend(FlightModel& model, FlightModel::Parameters& p, double bend_m);

/// Covariance of the parameters at the minimum, s^2 (J^T J)^-1 with Huber's variance of a centre's coordinate,
///   s^2 = [sum |psi_i|^2 / (2 n - parameters)] / (mean slope of psi)^2,  |psi_i| = min(|e_i|, bend),
/// the slope in the plane being 1 within the bend and bend / (2 |e_i|) beyond. Zero for a parameter that is not free.
FlightModel::Covariance covariance_of(FlightModel& model, const FlightModel::Parameters& p, double bend_m);

/// What a flight with lift, too, would be, by one Gauss-Newton step from the fit without.
struct LiftCheck {
  double coefficient = 0.0;  ///< C_L, positive upwards of the path
  double chi_square = 0.0;   ///< (C_L / its standard error)^2, one degree of freedom
  FlightModel::Parameters shift = FlightModel::Parameters::Zero();  ///< of the other parameters
};

/// With the centres weighted as in descend() and the variance that is left of them. Zero where lift cannot be told
/// from the free parameters.
LiftCheck check_lift(FlightModel& model, const FlightModel::Parameters& p, double bend_m);

}  // namespace trivela::kicking::lob
