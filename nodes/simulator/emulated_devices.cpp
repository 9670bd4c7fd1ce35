#include "nodes/simulator/emulated_devices.hpp"

#include <fmt/core.h>

#include <stdexcept>
#include <utility>

#include "nodes/runtime/node_context.hpp"

namespace trivela::nodes {
namespace {

namespace box = hal::refbox;

/// By letters a team is its colour.
std::size_t our_team(const config::Refbox& settings) {
  return settings.letters && settings.colour == config::TeamColour::kMagenta ? 1 : 0;
}

box::BoxConfig box_of(const config::Refbox& settings) {
  box::BoxConfig config;
  if (settings.letters) config.protocol = box::Protocol::kLetters;
  if (!settings.group.empty()) config.groups.at(our_team(settings)) = settings.group;
  return config;
}

const config::Settings& playable(const config::Settings& settings) {
  if (settings.run.lockstep)
    throw std::runtime_error{"simulator.devices = \"emulated\" with run.lockstep = true: a board waits for nobody"};
  if (settings.simulator.halves > std::uint32_t{box::RefereeOutput::kMostHalves}) {
    throw std::runtime_error{
        fmt::format("simulator.halves = {}: a referee box has commands for {}, and simulator.devices = \"emulated\"",
                    settings.simulator.halves, box::RefereeOutput::kMostHalves)};
  }
  return settings;
}

}  // namespace

EmulatedDevices::EmulatedDevices(const config::Settings& settings, const kicking::WheelBase& base,
                                 std::shared_ptr<spdlog::logger> logger)
    : logger_(std::move(logger)),
      kicker_(hal::emulated_kicker(playable(settings).hal.kicker)),
      base_(hal::emulated_wheels(settings.hal.wheels, base)),
      gyro_(hal::emulated_gyro(settings.hal.gyro)),
      box_(box_of(settings.refbox)),
      referee_output_(our_team(settings.refbox)) {}

std::vector<std::string> EmulatedDevices::settings() const {
  std::vector<std::string> lines{"refbox.host=\"127.0.0.1\"", fmt::format("refbox.port={}", box_.port())};
  if (kicker_) lines.push_back(kicker_->setting());
  if (base_) lines.push_back(base_->setting());
  if (gyro_) lines.push_back(gyro_->setting());
  return lines;
}

bool EmulatedDevices::wait_for_nodes(const bus::Stop& stop) {
  const auto asked = [this](auto timeout) { return !kicker_ || kicker_->wait_for_host(timeout); };
  const auto turns = [this](auto timeout) { return !base_ || base_->wait_for_host(timeout); };
  const auto came = [this](auto timeout) { return box_.wait_for_teams(1, timeout); };
  return ready_before_stop(stop, asked, "no kicker_driver has asked the emulated board") &&
         ready_before_stop(stop, turns, "no odometry has the emulated drives in operation") &&
         ready_before_stop(stop, came, "no refbox has come to the emulated referee box");
}

void EmulatedDevices::show(const sim::Sensors& sensors) {
  say(referee_output_.receive(sensors.referee));
  if (base_) base_->show(sensors.wheels.wheel_radps);
  if (gyro_) gyro_->show(sensors.wheels.gyro_radps);
  if (kicker_) kicker_->show(sensors.kicker.charge, sensors.kicker.armed);
}

std::vector<hal::CoilPulse> EmulatedDevices::take_pulses() {
  if (!kicker_) return {};
  std::vector<hal::CoilPulse> pulses = kicker_->take_pulses();
  for (const hal::CoilPulse& pulse : pulses)
    logger_->info("pulse of {:.3f} ms at {} ns", pulse.length_us / 1000.0, pulse.t_ns);
  return pulses;
}

void EmulatedDevices::say_over() { say(box::RefereeOutput::over()); }

void EmulatedDevices::say(const std::vector<box::BoxCommand>& words) {
  for (const box::BoxCommand& word : words) {
    const std::int64_t t_ns = now_ns(std::chrono::steady_clock::now());
    box_.act(word);
    logger_->info("{} said by the box at {} ns", box::name(word.kind), t_ns);
  }
}

}  // namespace trivela::nodes
