#include "hal/bus/bus_wheels.hpp"

#include <algorithm>
#include <cmath>
#include <exception>

#include "hal/bus/bus_streams.hpp"
#include "hal/open.hpp"
#include "kicking/geometry/time.hpp"

namespace trivela::hal {

BusWheels::BusWheels(const bus::Participant& participant, std::uint8_t robot_id)
    : robot_id_(robot_id), samples_(participant), drives_(participant), turns_(participant) {}

BusWheels::~BusWheels() {
  try {
    drive({}, drive_t_ns_);
  } catch (const std::exception&) {
    // The bus is gone; the bridge stops for want of commands.
  }
}

bool BusWheels::connected(std::chrono::nanoseconds timeout) { return both_ways(samples_, drives_, timeout); }

std::optional<WheelSample> BusWheels::read(std::chrono::nanoseconds timeout) {
  const auto received = read_newer(samples_, robot_id_, read_t_ns_, timeout);
  if (!received) return std::nullopt;
  WheelSample sample{.t_ns = received->t_ns,
                     .wheel_count = std::min<int>(received->wheel_count, 4),
                     .wheel_radps = {},
                     .gyro_radps = received->gyro_radps,
                     .emulated = received->emulated,
                     .gyro_emulated = false};
  std::copy_n(std::begin(received->wheel_radps), sample.wheel_count, sample.wheel_radps.begin());
  if (!sample.gyro_radps) add_gyro(sample);
  return sample;
}

/// The latest that a gyro of its own said, where it is of the sample's time.
void BusWheels::add_gyro(WheelSample& sample) {
  constexpr double kSameTime_s = 0.05;  // a gyro of 50 Hz may lose a sample
  if (const auto said = read_newer(turns_, robot_id_, turn_t_ns_, std::chrono::nanoseconds::zero())) turn_ = *said;
  if (!turn_t_ns_ || std::abs(kicking::seconds(sample.t_ns - *turn_t_ns_)) > kSameTime_s) return;
  sample.gyro_radps = turn_.gyro_radps;
  sample.gyro_emulated = turn_.emulated;
}

void BusWheels::drive(const kicking::Twist& set_point, std::int64_t t_ns) {
  const bool finite =
      std::isfinite(set_point.vx_mps) && std::isfinite(set_point.vy_mps) && std::isfinite(set_point.omega_radps);
  const kicking::Twist twist = finite ? set_point : kicking::Twist{};
  msg::DeviceDrive command{};
  command.vx_mps = twist.vx_mps;
  command.vy_mps = twist.vy_mps;
  command.omega_radps = twist.omega_radps;
  send(command, t_ns);
}

bool BusWheels::drive_wheel(int wheel, double radps, std::int64_t t_ns) {
  msg::DeviceDrive command{};
  command.wheels_alone = true;
  command.wheel_radps[wheel] = std::isfinite(radps) ? radps : 0.0;
  send(command, t_ns);
  return true;
}

void BusWheels::send(msg::DeviceDrive command, std::int64_t t_ns) {
  drive_t_ns_ = t_ns;
  command.robot_id = robot_id_;
  command.seq = ++drive_seq_;
  command.t_ns = t_ns;
  drives_.write(command);
}

}  // namespace trivela::hal

namespace trivela::config {

std::unique_ptr<hal::Wheels> wheels_of(const BusDevice&, const Hal&, const hal::Owner& owner, hal::WheelsUse) {
  return std::make_unique<hal::BusWheels>(owner.participant, owner.robot_id);
}

}  // namespace trivela::config
