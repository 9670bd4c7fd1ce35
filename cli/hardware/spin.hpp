#pragma once

#include <string>
#include <vector>

#include "cli/launch/person.hpp"
#include "config/robot.hpp"
#include "hal/wheels.hpp"

namespace trivela::cli {

/// Which wheel, counted from 0, is turned how.
struct Spin {
  int wheel = 0;
  double radps = 2.0;
  double seconds = 2.0;
};

/// What the wheels did meanwhile: their speeds in the second half of it, rad/s.
struct SpinReading {
  std::vector<double> mean_radps;  ///< of each wheel
};

/// What is wrong with it, as a sentence: a wheel that does not turn, turns the other way or half or double as fast, or
/// another that turns; empty: nothing.
std::string spin_problem(const Spin& spin, const SpinReading& reading);

/// Turns one wheel for its time and stops it, whatever happens: also when somebody asks to stop, and then says so. The
/// others stand. Throws std::runtime_error where this base cannot turn one wheel alone, or its wheels say nothing; at
/// once, and without a figure, where they are lost meanwhile. Returns the exit code.
int spin_wheel(const Spin& spin, hal::Wheels& wheels, const config::WheelBase& base, SignalInbox& signals);

}  // namespace trivela::cli
