#pragma once

#include <cstdint>
#include <optional>

#include "bus/domain/participant.hpp"
#include "bus/reader.hpp"
#include "bus/writer.hpp"
#include "hal/wheels.hpp"
#include "idl/messages.hpp"

namespace trivela::hal {

/// The base behind a bridge: device/wheels in, device/drive out. A sample that was not read before the next arrived is
/// gone, as with a device register. A sample without a gyro is given the latest of device/gyro, if that is of its time.
class BusWheels final : public Wheels {
 public:
  /// Throws bus::Error if the bus refuses.
  BusWheels(const bus::Participant& participant, std::uint8_t robot_id);
  ~BusWheels() override;
  BusWheels(const BusWheels&) = delete;
  BusWheels& operator=(const BusWheels&) = delete;

  bool connected(std::chrono::nanoseconds timeout) override;
  std::optional<WheelSample> read(std::chrono::nanoseconds timeout) override;
  void drive(const kicking::Twist& set_point, std::int64_t t_ns) override;
  bool drive_wheel(int wheel, double radps, std::int64_t t_ns) override;

 private:
  void send(msg::DeviceDrive command, std::int64_t t_ns);
  void add_gyro(WheelSample& sample);

  std::uint8_t robot_id_;
  bus::Reader<msg::DeviceWheels> samples_;
  bus::Writer<msg::DeviceDrive> drives_;
  std::optional<std::int64_t> read_t_ns_;
  bus::Reader<msg::DeviceGyro> turns_;
  std::optional<std::int64_t> turn_t_ns_;  // none: none has come
  msg::DeviceGyro turn_{};
  std::uint64_t drive_seq_ = 0;
  std::int64_t drive_t_ns_ = 0;
};

}  // namespace trivela::hal
