#pragma once

#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <string>
#include <variant>

#include "config/settings.hpp"
#include "hal/open.hpp"

namespace trivela::cli {

/// A device that the configuration names, as a person sees it. look() and found() are for one thread.
class DeviceProbe {
 public:
  DeviceProbe(std::string name, std::string device) : name_(std::move(name)), device_(std::move(device)) {}
  virtual ~DeviceProbe() = default;

  const std::string& name() const { return name_; }      ///< "kicker"
  const std::string& device() const { return device_; }  ///< as the configuration has it: "ioboard on /dev/ttyUSB0"

  /// The configuration means it to be there.
  virtual bool wanted() const { return true; }
  /// Nobody else has it.
  virtual bool opened() const { return true; }
  /// It answers.
  virtual bool found() = 0;
  /// What it says of itself and of its link; empty: nothing.
  virtual std::string says() const = 0;

  /// Takes what has come, without waiting.
  virtual void look() = 0;
  /// The newest values, and how many came within the last second or how old they are.
  virtual std::string values() = 0;

 private:
  std::string name_;
  std::string device_;
};

/// What came within the last second.
class Rate {
 public:
  void count() { ++now_; }
  /// "50/s", counted over the time since it was asked last.
  std::string text();

 private:
  std::size_t now_ = 0;
  std::chrono::steady_clock::time_point since_ = std::chrono::steady_clock::now();
};

/// "ioboard on /dev/ttyUSB0", "sim".
template <class... Backends>
std::string device_text(const std::variant<Backends...>& device) {
  return std::visit(
      []<class Backend>(const Backend& backend) {
        if constexpr (requires { backend.port; })
          return fmt::format("{} on {}", Backend::kName, backend.port);
        else
          return config::text_of(backend);
      },
      device);
}

/// "0.42 (modelled), armed".
std::string kicker_text(const hal::KickerSample& sample);

/// "wheel 1 0.00, wheel 2 1.99 rad/s; gyro 0.01 rad/s".
std::string wheels_text(const hal::WheelSample& sample);

/// One that somebody else has, `node` or another program of this kind: it is not opened.
std::unique_ptr<DeviceProbe> held_by(const std::string& name, const std::string& device, const std::string& node);
std::unique_ptr<DeviceProbe> wheels_probe(std::unique_ptr<hal::Wheels> wheels, const std::string& device);
std::unique_ptr<DeviceProbe> kicker_probe(std::unique_ptr<hal::Kicker> kicker, const std::string& device);
/// A gyro beside the wheels; it answers while its newest sample is no older than half a second.
std::unique_ptr<DeviceProbe> gyro_probe(std::unique_ptr<hal::Gyro> gyro, const std::string& device);
/// Where no scans are to be recorded it is none that is wanted, and nothing is opened.
std::unique_ptr<DeviceProbe> range_finder_probe(const config::ScanRecorder& settings, const hal::Owner& owner);
/// A referee box is named.
bool is_wanted(const config::Refbox& settings);
/// The same where it is not.
std::unique_ptr<DeviceProbe> referee_box_probe(const config::Refbox& settings);

}  // namespace trivela::cli
