#include "cli/hardware/tasks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "cli/options/output.hpp"
#include "cli/verbs.hpp"
#include "kicking/model/omni_kinematics.hpp"

namespace trivela::cli {
namespace {

using SpinClock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kCommandPeriod{20};  // a base stops that hears nothing for some tenths of a second
constexpr std::chrono::milliseconds kSilence{500};       // of a base that has been lost

/// What the wheels said before is no answer to what they do now.
std::runtime_error lost(const Spin& spin, const hal::Wheels& wheels) {
  const std::string status = wheels.status();
  return std::runtime_error{
      fmt::format("link to the wheels lost{}{}: whether wheel {} stands is not known; use the stop button",
                  status.empty() ? "" : ", ", status, spin.wheel + 1)};
}

void turn(const Spin& spin, hal::Wheels& wheels, const kicking::OmniKinematics& kinematics) {
  if (const auto twist = kinematics.one_wheel(spin.wheel, spin.radps)) {
    wheels.drive(*twist, steady_ns());
  } else if (!wheels.drive_wheel(spin.wheel, spin.radps, steady_ns())) {
    throw std::runtime_error{fmt::format(
        "wheel {} cannot be turned alone: this device takes velocities of the whole base, and a base of {} wheels has "
        "none at which one alone turns",
        spin.wheel + 1, kinematics.wheel_count())};
  }
}

/// Sums of the samples of the second half.
class Mean {
 public:
  void add(const hal::WheelSample& sample) {
    sums_.resize(static_cast<std::size_t>(sample.wheel_count), 0.0);
    for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += sample.wheel_radps[i];
    ++count_;
  }
  bool empty() const { return count_ == 0; }
  SpinReading reading() const {
    SpinReading reading;
    for (const double sum : sums_) reading.mean_radps.push_back(sum / count_);
    return reading;
  }

 private:
  std::vector<double> sums_;
  int count_ = 0;
};

}  // namespace

std::string spin_problem(const Spin& spin, const SpinReading& reading) {
  const auto wheel = static_cast<std::size_t>(spin.wheel);
  if (wheel >= reading.mean_radps.size()) return "its speed was not reported";
  constexpr double kStill_ratio = 0.25, kHalf_ratio = 0.5, kDouble_ratio = 2.0;
  const double ratio = reading.mean_radps[wheel] / spin.radps;
  for (std::size_t i = 0; i < reading.mean_radps.size(); ++i) {
    if (i != wheel && std::abs(reading.mean_radps[i]) > kStill_ratio * std::abs(spin.radps) &&
        std::abs(reading.mean_radps[i]) > std::abs(reading.mean_radps[wheel]))
      return fmt::format("wheel {} turned in its place: their order is another one", i + 1);
  }
  if (std::abs(ratio) < kStill_ratio) return "it did not turn";
  if (ratio < 0.0) return "it turned the other way: its sign, or that of its encoder, is wrong";
  if (ratio < kHalf_ratio || ratio > kDouble_ratio)
    return fmt::format("it turned {:.2f} times as fast: gear or encoder", ratio);
  for (std::size_t i = 0; i < reading.mean_radps.size(); ++i) {
    if (i != wheel && std::abs(reading.mean_radps[i]) > kStill_ratio * std::abs(spin.radps))
      return fmt::format("wheel {} turned with it", i + 1);
  }
  return {};
}

int spin_wheel(const Spin& spin, hal::Wheels& wheels, const config::WheelBase& base, SignalInbox& signals) {
  const kicking::OmniKinematics kinematics{base};
  Mean mean;
  std::optional<hal::WheelSample> newest;
  const Afterwards at_rest{[&] { wheels.drive({}, steady_ns()); }};
  const auto began = SpinClock::now();
  const auto lasts = std::chrono::duration<double>(spin.seconds);
  auto received = began;
  while (SpinClock::now() - began < lasts) {
    turn(spin, wheels, kinematics);
    if (signals.stop_requested_within(static_cast<int>(kCommandPeriod.count()))) {
      warn("stopped: the wheels get the command to stand");
      return kFailed;
    }
    for (auto sample = wheels.read(std::chrono::nanoseconds{0}); sample;
         sample = wheels.read(std::chrono::nanoseconds{0})) {
      newest = sample;
      received = SpinClock::now();
      if (received - began > lasts / 2) mean.add(*sample);
    }
    if (SpinClock::now() - received > kSilence || !wheels.connected(std::chrono::nanoseconds{0}))
      throw lost(spin, wheels);
  }
  if (!newest) throw std::runtime_error{"the wheels say nothing"};
  if (mean.empty()) throw lost(spin, wheels);
  say(fmt::format("asked wheel {} for {:.2f} rad/s; {}\n", spin.wheel + 1, spin.radps, wheels_text(*newest)));
  const std::string problem = spin_problem(spin, mean.reading());
  if (problem.empty()) return kDone;
  warn(fmt::format("wheel {}: {}", spin.wheel + 1, problem));
  return kFailed;
}

}  // namespace trivela::cli
