#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "kicking/optional_double.hpp"

namespace trivela::kicking {

/// Root of f in [low, high] where f(low) <= 0 <= f(high): false position with the Illinois rule, halving where that is
/// slow. None if the ends do not bracket a root.
template <typename Function>
OptionalDouble bracketed_root(const Function& f, double low, double high) {
  double f_low = f(low);
  double f_high = f(high);
  if (!(f_low <= 0.0 && f_high >= 0.0)) return std::nullopt;
  int same_side = 0;
  for (int i = 0; i < 200 && f_low < 0.0 && f_high > 0.0; ++i) {
    const double width = high - low;
    if (width <= 4e-16 * std::max(std::abs(low), std::abs(high))) break;
    const double middle = i % 8 == 7 ? low + 0.5 * width : low - f_low * width / (f_high - f_low);
    if (middle <= low || middle >= high) break;
    const double value = f(middle);
    if (value <= 0.0) {
      low = middle;
      f_low = value;
      if (same_side == -1) f_high *= 0.5;
      same_side = -1;
    } else {
      high = middle;
      f_high = value;
      if (same_side == 1) f_low *= 0.5;
      same_side = 1;
    }
  }
  return std::abs(f_low) < std::abs(f_high) ? low : high;
}

/// The first of start, 2 start, 4 start, ... where f >= 0; none below the limit.
template <typename Function>
OptionalDouble doubled_until_positive(const Function& f, double start, double limit) {
  for (double x = start; x < limit; x *= 2.0) {
    if (f(x) >= 0.0) return x;
  }
  return std::nullopt;
}

/// Slopes at the four stages of a step.
template <typename State>
struct Slopes {
  State k1, k2, k3, k4;
};

/// The stages of the classical Runge-Kutta method, of order 4, for ds/dt = rate(s).
template <typename State, typename Rate>
Slopes<State> slopes(const State& state, double step, const Rate& rate) {
  const State k1 = rate(state);
  const State k2 = rate(State(state + 0.5 * step * k1));
  const State k3 = rate(State(state + 0.5 * step * k2));
  const State k4 = rate(State(state + step * k3));
  return {k1, k2, k3, k4};
}

/// The state a step later.
template <typename State, typename Rate>
State runge_kutta(const State& state, double step, const Rate& rate) {
  const auto& [k1, k2, k3, k4] = slopes(state, step, rate);
  return state + step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
}

}  // namespace trivela::kicking
