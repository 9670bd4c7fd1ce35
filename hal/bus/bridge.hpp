#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

#include "bus/domain/participant.hpp"
#include "bus/reader.hpp"
#include "bus/renewal.hpp"
#include "bus/writer.hpp"
#include "hal/kicker.hpp"
#include "hal/wheels.hpp"
#include "idl/messages.hpp"

namespace trivela::hal {

/// Somebody writes what `reader` reads and somebody reads what `writer` writes; waits up to the timeout for that.
inline bool both_ways(bus::AnyReader& reader, const bus::AnyWriter& writer, std::chrono::nanoseconds timeout) {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  if (!reader.wait_for_writers(1, timeout)) return false;
  const auto left = deadline - std::chrono::steady_clock::now();
  return writer.wait_for_readers(1, std::max<std::chrono::nanoseconds>(left, std::chrono::nanoseconds::zero()));
}

/// The robot's latest sample that is newer than `after_t_ns`, waiting up to the timeout for it. Samples of other robots
/// and older ones are passed over, as is one of an instant that cannot be true. `after_t_ns` then is the sample's
/// instant. `see` is given each sample of the robot, also those that are passed over.
template <class T>
std::optional<T> read_newer(bus::Reader<T>& reader, std::uint8_t robot_id, std::optional<std::int64_t>& after_t_ns,
                            std::chrono::nanoseconds timeout,
                            const std::function<void(const bus::SampleInfo&)>& see = {}) {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  for (;;) {
    bus::renew_if_silent(reader);
    std::optional<T> newest;
    reader.take([&](const T& sample, const bus::SampleInfo& info) {
      if (sample.robot_id == robot_id && see) see(info);
      if (sample.robot_id != robot_id || (after_t_ns && sample.t_ns <= *after_t_ns)) return;
      if (!reader.participant().believes(sample.t_ns)) return;  // or all that follow would be older
      newest = sample;
      after_t_ns = sample.t_ns;
    });
    if (newest) return newest;
    const auto left = deadline - std::chrono::steady_clock::now();
    if (left <= left.zero() || !reader.wait(left)) return std::nullopt;
  }
}

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

/// The kicker behind a bridge: device/kicker in, device/fire and, for a board that can do it, device/charge out. An
/// order is for the bridge that is there: before connected() here, and before the bridge's reader knows this writer, it
/// is lost.
class BusKicker final : public Kicker {
 public:
  /// Throws bus::Error if the bus refuses.
  BusKicker(const bus::Participant& participant, std::uint8_t robot_id);
  ~BusKicker() override { make_safe(); }
  BusKicker(const BusKicker&) = delete;
  BusKicker& operator=(const BusKicker&) = delete;

  bool connected(std::chrono::nanoseconds timeout) override;
  std::optional<KickerSample> read(std::chrono::nanoseconds timeout) override;
  void fire(const Shot& shot) override;
  void withdraw(std::int64_t kick_id) override;
  void hold_when(const Hold& hold) override { hold_ = hold; }
  void call_when_written(const std::function<void()>& written) override { written_ = written; }
  std::optional<ShotResult> take_result() override;
  void charge(ChargeCommand word) override;
  /// Said with the next charge().
  void lever(std::uint8_t kick_kind) override { lever_kind_ = kick_kind; }
  void make_safe() noexcept override;
  /// That several bridges write, which is a fault of the link while it lasts.
  std::string status() const override;
  /// As the latest sample says.
  KickerCapabilities capabilities() const override { return capabilities_; }

 private:
  void write_charge(ChargeCommand word);

  std::uint8_t robot_id_;
  bus::Reader<msg::DeviceKicker> samples_;
  bus::Writer<msg::DeviceFire> fires_;
  std::optional<std::int64_t> read_t_ns_;
  bus::WriterWatch bridges_;
  std::atomic<bool> contested_ = false;
  bus::Writer<msg::DeviceCharge> charges_;
  std::uint64_t fire_seq_ = 0;
  std::atomic<std::uint64_t> charge_seq_ = 0;
  std::atomic<KickerCapabilities> capabilities_{};
  std::atomic<std::uint8_t> lever_kind_ = 0;
  std::atomic<bool> safe_ = false;
  Hold hold_;
  std::function<void()> written_;
  std::optional<ShotResult> dropped_;
};

}  // namespace trivela::hal
