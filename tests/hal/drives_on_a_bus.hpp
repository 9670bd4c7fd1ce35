#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <memory>
#include <string>

#include "emulators/cia402/emulated_wheels.hpp"
#include "hal/cia402/cia402_wheels.hpp"

namespace trivela::tests {

inline constexpr std::int64_t kStep_ns = 1'000'000;

/// A bus in place of time: what is written is taken at once, and what the drives say is there to be read.
class BusOfDrives final : public hal::Line {
 public:
  BusOfDrives(hal::cia402::EmulatedDrives& drives, const std::int64_t& now_ns, const bool& plugged)
      : drives_(drives), now_ns_(now_ns), plugged_(plugged) {}

  Opening open(Deadline) override { return plugged_ ? Opening::kOpen : Opening::kFailed; }
  std::optional<std::size_t> read(std::span<char> bytes, Deadline) override {
    if (!plugged_) return std::nullopt;
    if (drives_.next_ns() <= now_ns_) add(drives_.tick(now_ns_));
    if (said_.empty()) return 0;
    const std::size_t count = said_.front().copy(bytes.data(), bytes.size());
    said_.pop_front();
    return count;
  }
  bool write(std::string_view bytes, Deadline) override {
    if (!plugged_) return false;
    add(drives_.take(bytes, now_ns_));
    return true;
  }
  void close() noexcept override { said_.clear(); }
  int descriptor() const override { return -1; }
  const std::string& name() const override { return name_; }
  const std::string& why() const override { return why_; }

 private:
  void add(std::vector<std::string> messages) {
    for (std::string& message : messages) said_.push_back(std::move(message));
  }

  hal::cia402::EmulatedDrives& drives_;
  const std::int64_t& now_ns_;
  const bool& plugged_;
  std::deque<std::string> said_;
  std::string name_ = "can0";
  std::string why_ = "no such device";
};

/// Emulated drives and what drives them, at instants that the test names; the base of the default robot, three wheels.
class DrivesOnABus {
 public:
  explicit DrivesOnABus(config::Cia402Device settings = {.gear = 12.0}) : settings_(std::move(settings)) { start(); }

  /// Another start of the program.
  void start(hal::WheelsUse use = hal::WheelsUse::kDrive) {
    client = std::make_unique<hal::cia402::Drives>(std::make_unique<BusOfDrives>(drives, now_ns, plugged), settings_,
                                                   kicking::WheelBase{}, use);
  }

  void run(double span_s) {
    for (const std::int64_t end_ns = now_ns + std::llround(span_s * 1e9); now_ns < end_ns; now_ns += kStep_ns)
      client->step(now_ns);
  }
  /// The program stands still, or has died: the drives go on, and what they say waits to be read.
  void stall(double span_s) {
    for (const std::int64_t end_ns = now_ns + std::llround(span_s * 1e9); now_ns < end_ns; now_ns += kStep_ns) {
      for (const std::string& said : drives.tick(now_ns)) drives.say(hal::can::decode(said).at(0));
    }
  }
  /// The cable is out: both sides go on, and what the drives say is lost.
  void unplug(double span_s) {
    plugged = false;
    for (const std::int64_t end_ns = now_ns + std::llround(span_s * 1e9); now_ns < end_ns; now_ns += kStep_ns) {
      drives.tick(now_ns);
      client->step(now_ns);
    }
    plugged = true;
  }
  /// Runs until every drive is in operation.
  void bring_up() {
    for (int i = 0; i < 5000 && !client->up(); ++i) run(0.001);
    ASSERT_TRUE(client->up()) << client->status();
    client->take_sample();
  }
  hal::cia402::EmulatedDrive& drive(std::uint8_t node) { return drives.drive(node); }
  double rpm(std::uint8_t node) { return drive(node).rpm(now_ns); }

  std::int64_t now_ns = 1'000'000'000;
  bool plugged = true;
  hal::cia402::EmulatedDrives drives{3};
  std::unique_ptr<hal::cia402::Drives> client;

 private:
  config::Cia402Device settings_;
};

}  // namespace trivela::tests
