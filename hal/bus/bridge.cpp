#include "hal/bus/bridge.hpp"

#include <fmt/core.h>

#include <cmath>
#include <exception>

#include "bus/node.hpp"
#include "hal/open.hpp"
#include "kicking/geometry/time.hpp"
#include "kicking/optional_double.hpp"

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

namespace trivela::hal {
namespace {

KickerFault fault_of(msg::KickerFault fault) {
  switch (fault) {
    case msg::FAULT_NONE:
      return KickerFault::kNone;
    case msg::FAULT_CHARGER:
      return KickerFault::kCharger;
    case msg::FAULT_COIL:
      return KickerFault::kCoil;
    default:
      return KickerFault::kLink;
  }
}

std::int64_t now_ns() { return std::chrono::steady_clock::now().time_since_epoch().count(); }

}  // namespace

BusKicker::BusKicker(const bus::Participant& participant, std::uint8_t robot_id)
    : robot_id_(robot_id),
      samples_(participant),
      // The coil hears one driver, however long that says nothing.
      fires_(participant, {.period = {},
                           .lease = std::chrono::hours(24),
                           .strength = 0,
                           .owner = bus::owner_of_robot("kicker_driver", robot_id)}),
      charges_(participant) {}

bool BusKicker::connected(std::chrono::nanoseconds timeout) { return both_ways(samples_, fires_, timeout); }

std::optional<KickerSample> BusKicker::read(std::chrono::nanoseconds timeout) {
  const auto see = [this](const bus::SampleInfo& info) { bridges_.see(info.writer, now_ns()); };
  const auto received = read_newer(samples_, robot_id_, read_t_ns_, timeout, see);
  if (!received) return std::nullopt;
  contested_ = bridges_.contested(now_ns());
  const kicking::OptionalDouble voltage_v = received->voltage_v;
  capabilities_ = {.charge_control = received->charge_control,
                   .voltage = voltage_v.has_value(),
                   .discharge = received->discharge,
                   .watchdog = received->watchdog,
                   .lever = received->lever};
  return KickerSample{.t_ns = received->t_ns,
                      .charge = received->charge,
                      .armed = received->armed,
                      .fault = contested_ ? KickerFault::kLink : fault_of(received->fault),
                      .charge_modelled = received->charge_modelled,
                      .voltage_v = voltage_v,
                      .emulated = received->emulated,
                      .lever_kind = received->lever_kind};
}

void BusKicker::fire(const Shot& shot) {
  msg::DeviceFire order{};
  order.robot_id = robot_id_;
  order.seq = ++fire_seq_;
  order.t_ns = shot.t_ns;
  order.kick_id = shot.kick_id;
  order.power = shot.power;
  order.kick_kind = shot.kick_kind;
  if (safe_) return;
  const bool late = shot.until_ns != kNoDeadline_ns && now_ns() > shot.until_ns;
  if (late || (hold_ && hold_(shot.judged_ns))) {
    dropped_ = ShotResult{shot.kick_id, late ? ShotResult::What::kLate : ShotResult::What::kCalledOff, now_ns()};
    return;
  }
  fires_.write(order);
  if (written_) written_();
}

std::optional<ShotResult> BusKicker::take_result() { return std::exchange(dropped_, std::nullopt); }

void BusKicker::withdraw(std::int64_t kick_id) {
  msg::DeviceFire word{};
  word.robot_id = robot_id_;
  word.seq = ++fire_seq_;
  word.kick_id = kick_id;
  word.withdrawn = true;
  fires_.write(word);
}

std::string BusKicker::status() const {
  if (!contested_) return {};
  return fmt::format("several programs write device/kicker of robot {}: nothing is fired; stop all but one", robot_id_);
}

void BusKicker::charge(ChargeCommand word) {
  if (!safe_) write_charge(word);
}

void BusKicker::make_safe() noexcept {
  safe_ = true;
  try {
    write_charge(ChargeCommand::kDischarge);
  } catch (const std::exception&) {
    // The bus is gone; the bridge holds for want of words.
  }
}

void BusKicker::write_charge(ChargeCommand word) {
  const KickerCapabilities can = capabilities_;
  if (!can.charge_control && !can.discharge && !can.lever) return;
  msg::DeviceCharge out{};
  out.robot_id = robot_id_;
  out.seq = ++charge_seq_;
  out.t_ns = now_ns();
  out.word = word == ChargeCommand::kCharge      ? msg::CHARGE_UP
             : word == ChargeCommand::kDischarge ? msg::CHARGE_EMPTY
                                                 : msg::CHARGE_HOLD;
  out.lever_kind = lever_kind_;
  charges_.write(out);
}

}  // namespace trivela::hal

namespace trivela::config {

std::unique_ptr<hal::Kicker> kicker_of(const BusDevice&, const Hal&, const hal::Owner& owner) {
  return std::make_unique<hal::BusKicker>(owner.participant, owner.robot_id);
}

}  // namespace trivela::config
