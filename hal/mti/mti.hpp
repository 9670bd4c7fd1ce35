#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "config/devices.hpp"
#include "hal/gyro.hpp"
#include "hal/line/device_clock.hpp"
#include "hal/line/line.hpp"
#include "hal/line/line_thread.hpp"
#include "hal/mti/message.hpp"

namespace trivela::hal::mti {

/// An MTi on its line. Nothing is ever written to it: what it says is set once with its maker's program. A sample is of
/// the instant of its sample time (0x1060), where it says that, else of its arrival. Silent for kSilence_ns: the line
/// is opened again between pauses.
class Mti final : public LineClient {
 public:
  static constexpr std::int64_t kSilence_ns = 500'000'000;

  Mti(std::unique_ptr<Line> line, const config::MtiDevice& settings);

  void step(std::int64_t now_ns) override;
  std::int64_t next_ns() const override;
  int descriptor() const override { return line_->descriptor(); }

  const std::optional<GyroSample>& newest() const { return newest_; }
  const std::string& status() const { return status_; }

 private:
  void open(std::int64_t now_ns);
  void receive(std::int64_t now_ns);
  void take(const Reading& reading, std::int64_t now_ns);
  void lose(const std::string& why, std::int64_t now_ns);
  std::string why_without_samples() const;

  std::unique_ptr<Line> line_;
  double sign_;
  bool open_ = false;
  std::int64_t next_open_ns_ = 0;
  std::int64_t received_ns_ = 0;
  MessageParser parser_;
  std::optional<std::uint8_t> other_message_;  // since the line was opened, one that is no measurement
  std::optional<DeviceClock> clock_;
  std::optional<GyroSample> newest_;
  std::string status_;
};

/// The same with its thread.
class MtiGyro final : public Gyro {
 public:
  /// Throws std::system_error where the system has no thread.
  MtiGyro(std::unique_ptr<Line> line, const config::MtiDevice& settings)
      : mti_(std::move(line), settings), thread_(mti_, "gyro") {}

  std::optional<GyroSample> newest() const override {
    return thread_.with_client([this] { return mti_.newest(); });
  }
  std::string status() const override {
    return thread_.with_client([this] { return mti_.status(); });
  }

 private:
  Mti mti_;
  LineThread thread_;
};

}  // namespace trivela::hal::mti
