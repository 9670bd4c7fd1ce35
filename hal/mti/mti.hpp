#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "config/devices.hpp"
#include "hal/gyro.hpp"
#include "hal/line/device_clock.hpp"
#include "hal/line/line.hpp"
#include "hal/line/line_thread.hpp"

/// What an Xsens MTi says: FA FF, a message's number, its length, its data (big endian) and a sum. Source:
/// jonlamb-gh/xsens-mti, README.md and src/.
namespace trivela::hal::mti {

inline constexpr std::uint8_t kMtData2 = 0x36;

struct Message {
  std::uint8_t id = 0;
  std::string data;
  bool operator==(const Message&) const = default;
};

std::string encode(const Message& message);

/// Messages out of the pieces in which they come; what is none is passed over.
class MessageParser {
 public:
  static constexpr std::size_t kLongestData = 2048;

  /// Those that are whole now.
  std::vector<Message> take(std::string_view bytes);

 private:
  std::optional<Message> next();

  std::string bytes_;  // not yet read
};

/// What of an MTData2 a turn rate needs.
struct Reading {
  static constexpr std::int64_t kTick_ns = 100'000;  ///< of sample_time

  std::optional<std::uint32_t> sample_time;         ///< 0x1060: ticks of its own clock, in 32 bits
  std::optional<std::array<double, 3>> rate_radps;  ///< 0x802_: about its own axes
  bool fixed_point = false;                         ///< its rate is there, but in a format that is not read
};

/// None: it is another message, or its parts do not fill it.
std::optional<Reading> reading_of(const Message& message);

/// A message that says it, with the rate as floats.
Message message_of(const Reading& reading);

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
