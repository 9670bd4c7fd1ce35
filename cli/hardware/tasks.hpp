#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/hardware/device_probes.hpp"
#include "cli/launch/signals.hpp"
#include "cli/launch/terminal.hpp"
#include "config/robot.hpp"
#include "config/settings.hpp"
#include "hal/kicker.hpp"
#include "hal/wheels.hpp"

namespace trivela::cli {

/// Calls `last` when it goes, by whichever way that is.
template <class Last>
struct Afterwards {
  explicit Afterwards(Last called) : last(std::move(called)) {}
  Afterwards(const Afterwards&) = delete;
  Afterwards& operator=(const Afterwards&) = delete;
  ~Afterwards() { last(); }

  Last last;
};
template <class Last>
Afterwards(Last) -> Afterwards<Last>;

/// This machine's steady clock.
inline std::int64_t steady_ns() {
  return std::chrono::nanoseconds{std::chrono::steady_clock::now().time_since_epoch()}.count();
}

using DeviceProbes = std::vector<std::unique_ptr<DeviceProbe>>;

/// Every device that is wanted was opened and answers.
bool all_answer(const DeviceProbes& probes);

/// A row for each: is it there, and what it says.
std::string listing(const DeviceProbes& probes);

/// Lists the devices, once all have answered or 3 s are over, and shows their values: on a terminal drawn over five
/// times a second until somebody asks to stop, else a line each second; both for `seconds`, where it is given, a
/// pipe's for one. Returns the exit code: kFailed where not all_answer(), or one did not for a while, which it warns
/// of.
int watch(DeviceProbes& probes, std::optional<double> seconds, SignalInbox& signals);

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

/// Why nobody is asked to lay a ball into this kicker, as a sentence that names the fault or the switch; empty: it
/// could fire. `status`: the kicker's.
std::string refused_at_once(const hal::KickerSample& sample, const config::KickerDevice& device,
                            const std::string& status);

/// One shot with the lowest set-point of the robot's table, after the person has typed the word. It passes the same
/// robot::OrderGate as every order of a match; what the referee would have to permit, the person does. The kicker is
/// safe afterwards, by whichever way this is left. Returns the exit code: kFailed where it was not confirmed, refused
/// or not carried out. Throws std::runtime_error where the kicker does not answer.
int fire_test_kick(hal::Kicker& kicker, const config::Settings& settings, const config::Robot& robot, Operator& user,
                   SignalInbox& signals);

}  // namespace trivela::cli
