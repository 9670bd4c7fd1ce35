#pragma once

namespace trivela::kicking {

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
