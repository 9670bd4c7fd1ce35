#include <fmt/core.h>
#include <fmt/ranges.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bus/domain/participant.hpp"
#include "cli/hardware/device_locks.hpp"
#include "cli/hardware/device_probes.hpp"
#include "cli/hardware/tasks.hpp"
#include "cli/launch/terminal.hpp"
#include "cli/options/match_mode.hpp"
#include "cli/options/number_checks.hpp"
#include "cli/options/output.hpp"
#include "cli/verbs.hpp"
#include "config/robot.hpp"
#include "config/settings.hpp"
#include "config/text/installation.hpp"
#include "nodes/runtime/node_main.hpp"

namespace trivela::cli {
namespace {

struct HardwareFlags {
  std::string config = config::shipped("default.toml").string();
  std::vector<std::string> overrides;
  std::optional<double> seconds;
  std::optional<int> spin;  ///< wheel, counted from 1
  double radps = 2.0;
  bool kick = false;
  bool armed = false;
};

/// One robot's devices, while nobody else has them.
struct Bench {
  config::Settings settings;
  config::Robot robot;
  SignalInbox& signals;
  bus::Participant participant;
  DeviceLocks claims;

  hal::Owner owner() const { return {participant, static_cast<std::uint8_t>(settings.run.robot_id), robot.base}; }
  config::Hal devices() const { return config::hal_for(settings.hal, robot); }
};

Bench bench_of(const HardwareFlags& flags, SignalInbox& signals) {
  config::Settings settings = config::load_settings(flags.config);
  config::override_settings(settings, flags.overrides, "--set");
  if (settings.run.lockstep) throw UsageError{"run.lockstep = true: devices wait for nobody"};
  if (flags.spin) refuse_in_a_match(settings, "a wheel's test");
  if (flags.kick) refuse_in_a_match(settings, "a test kick");
  config::Robot robot = config::robot_for(config::load_robot(settings.run.robot), settings);
  const bus::Participant participant{nodes::domain_of(settings.domain)};
  const auto robot_id = static_cast<std::uint8_t>(settings.run.robot_id);
  return {std::move(settings), std::move(robot), signals, participant, DeviceLocks{participant, robot_id}};
}

void say_who(const Bench& bench) {
  say(fmt::format("robot {} ({}) in domain {}\n", bench.settings.run.robot_id, bench.robot.name,
                  bench.settings.domain.domain_id));
  if (const auto figures = config::defaulted_figures(bench.settings.run.robot); !figures.empty())
    say(fmt::format("  not in {}, so defaults hold: {}\n", bench.settings.run.robot, fmt::join(figures, ", ")));
}

/// Wheels, and a gyro that is a device of its own.
void add_base(const Bench& bench, std::vector<std::unique_ptr<DeviceProbe>>& probes) {
  const config::Hal& devices = bench.settings.hal;
  const bool own_gyro = !std::holds_alternative<config::WheelsGyro>(devices.gyro);
  const std::string wheels = device_text(devices.wheels), gyro = device_text(devices.gyro);
  if (bench.claims.odometry_runs()) {
    probes.push_back(held_by("wheels", wheels, "odometry"));
    if (own_gyro) probes.push_back(held_by("gyro", gyro, "odometry"));
    return;
  }
  config::Hal wheels_alone = devices;
  wheels_alone.gyro = config::WheelsGyro{};
  probes.push_back(wheels_probe(hal::open_wheels(wheels_alone, bench.owner(), hal::WheelsUse::kListen), wheels));
  if (own_gyro) probes.push_back(gyro_probe(hal::open_gyro(devices.gyro), gyro));
}

int list_and_watch(const Bench& bench, std::optional<double> seconds) {
  const config::Settings& settings = bench.settings;
  const std::string kicker = device_text(settings.hal.kicker);
  std::vector<std::unique_ptr<DeviceProbe>> probes;
  add_base(bench, probes);
  probes.push_back(bench.claims.kicker_driver_runs()
                       ? held_by("kicker", kicker, "kicker_driver")
                       : kicker_probe(hal::open_kicker(bench.devices(), bench.owner()), kicker));
  probes.push_back(range_finder_probe(settings.scan_recorder, bench.owner()));
  probes.push_back(bench.claims.referee_is_written() && is_wanted(settings.refbox)
                       ? held_by("referee box", "none", "refbox, a simulator")
                       : referee_box_probe(settings.refbox));
  say_who(bench);
  return watch(probes, seconds, bench.signals);
}

int no_wheel_turned(const std::string& why) {
  warn(why + ": no wheel was turned");
  return kFailed;
}

/// False: somebody asked to stop before the wheels answered. Throws std::runtime_error where they do not within 5 s, of
/// which a drive may take 3 for its reset.
bool answers(hal::Wheels& wheels, const Bench& bench) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  while (!wheels.connected(std::chrono::milliseconds(50))) {
    if (bench.signals.stop_requested()) return false;
    if (std::chrono::steady_clock::now() < end) continue;
    const std::string status = wheels.status();
    throw std::runtime_error{fmt::format("wheels, {}: no answer{}{}", device_text(bench.settings.hal.wheels),
                                         status.empty() ? "" : "; ", status)};
  }
  return true;
}

int spin(const Bench& bench, const HardwareFlags& flags) {
  const std::size_t wheels = bench.robot.base.wheel_angles_rad.size();
  if (static_cast<std::size_t>(*flags.spin) > wheels)
    throw UsageError{fmt::format("--spin {}: {} has wheels 1 to {}", *flags.spin, bench.robot.name, wheels)};
  if (!Operator::is_there()) throw std::runtime_error{"--spin asks before it does it: standard input is no terminal"};
  bench.claims.require_wheels();
  if (!answers(*hal::open_wheels(bench.settings.hal, bench.owner(), hal::WheelsUse::kListen), bench))
    return no_wheel_turned("stopped");
  const Spin what{.wheel = *flags.spin - 1, .radps = flags.radps, .seconds = flags.seconds.value_or(2.0)};
  say_who(bench);
  say(fmt::format(
      "Wheel {} is to turn with {:.2f} rad/s for {:.1f} s, counter-clockwise about the robot's centre where "
      "positive.\nDo all wheels hang free, and nobody's hand near them?\n",
      *flags.spin, what.radps, what.seconds));
  Operator user{bench.signals};
  if (!user.confirms(fmt::format("spin {}", *flags.spin))) return no_wheel_turned("not confirmed");
  say("The motors get power now; Ctrl-C stops the wheel.\n");
  std::fflush(stdout);
  const auto device = hal::open_wheels(bench.settings.hal, bench.owner());
  if (!answers(*device, bench)) return no_wheel_turned("stopped");
  return spin_wheel(what, *device, bench.robot.base, bench.signals);
}

int kick(const Bench& bench) {
  if (!Operator::is_there()) throw std::runtime_error{"--kick asks before it does it: standard input is no terminal"};
  bench.claims.require_kicker();
  const auto device = hal::open_kicker(bench.devices(), bench.owner());
  say_who(bench);
  Operator user{bench.signals};
  return fire_test_kick(*device, bench.settings, bench.robot, user, bench.signals);
}

int run_hardware(const HardwareFlags& flags) {
  if (flags.kick && !flags.armed)
    throw UsageError{"--kick fires the kicker: it needs --armed, and nobody in front of the robot"};
  if (flags.armed && !flags.kick) throw UsageError{"--armed goes with --kick"};
  constexpr double kLongestSpin_s = 10.0;
  if (flags.spin && flags.seconds.value_or(0.0) > kLongestSpin_s)
    throw UsageError{fmt::format("--seconds {}: a wheel is turned for 10 s at most", *flags.seconds)};
  if (flags.radps == 0.0) throw UsageError{"--radps 0: the wheel would stand"};
  SignalInbox signals;  // before the threads of bus and devices, which must not take them
  const Bench bench = bench_of(flags, signals);
  if (flags.spin) return spin(bench, flags);
  if (flags.kick) return kick(bench);
  return list_and_watch(bench, flags.seconds);
}

}  // namespace

void add_hardware(CLI::App& app, int& exit_code) {
  const auto [verb, flags] = add_verb(app, exit_code, "hardware",
                                      "List a robot's devices, show what they say, try one at a time", run_hardware);
  verb->footer(
      R"(Opens what the nodes of this configuration would open. A device that somebody else has is left to them.
Exit codes: 0 all that is configured answers, or the test went well; 1 a device does not answer, did not for a
while or was not opened, a wheel did something else, a kick was refused, not confirmed or interrupted;
2 bad usage.)");
  add_default(*verb, "--config", flags->config, "configuration of the nodes");
  verb->add_option("--set", flags->overrides, "one setting on top, e.g. --set 'hal.kicker=\"ioboard\"'");
  verb->add_option("--seconds", flags->seconds,
                   "show values for so long (a line a second in a pipe); a spin's length, up to 10")
      ->check(between(0.1, 86400.0));
  auto* wheel = verb->add_option("--spin", flags->spin, "turn this wheel, counted from 1, after a typed confirmation")
                    ->check(CLI::Range(1, 4));
  verb->add_option("--radps", flags->radps, "spin: speed of the wheel, either way")
      ->needs(wheel)
      ->check(between(-5.0, 5.0))
      ->capture_default_str();
  verb->add_flag("--kick", flags->kick, "one kick with the lowest set-point, after a typed confirmation")
      ->excludes(wheel);
  verb->add_flag("--armed", flags->armed, "kick: the kicker may be fired");
}

}  // namespace trivela::cli
