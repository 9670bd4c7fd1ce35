#include "hal/cia402/cia402_wheels.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include "hal/can/can_line.hpp"
#include "hal/open.hpp"
#include "kicking/geometry/time.hpp"

namespace trivela::hal::cia402 {
namespace {

constexpr std::int64_t kOpenPause_ns = 100'000'000;
constexpr std::int64_t kNoteStands_ns = 1'000'000'000;
constexpr int kMostReads = 64;    // so that a flood keeps no command waiting
constexpr Line::Deadline kNow{};  // does not wait

std::vector<Drive> drives_of(const config::Cia402Device& settings, WheelsUse use) {
  std::vector<Drive> drives;
  std::set<std::uint8_t> nodes{settings.master};
  for (const std::uint8_t node : settings.nodes) {
    if (!nodes.insert(node).second)
      throw std::runtime_error{fmt::format("hal.cia402: node {} is there twice (nodes and master)", node)};
    drives.emplace_back(node, std::ranges::count(settings.reversed, node) > 0, settings, use);
  }
  for (const std::uint8_t node : settings.reversed) {
    if (node == settings.master || !nodes.contains(node))
      throw std::runtime_error{fmt::format("hal.cia402.reversed: node {} is none of hal.cia402.nodes", node)};
  }
  return drives;
}

}  // namespace

Drives::Drives(std::unique_ptr<Line> bus, const config::Cia402Device& settings, const kicking::WheelBase& base,
               WheelsUse use)
    : bus_(std::move(bus)),
      settings_(settings),
      kinematics_(base),
      use_(use),
      drives_(drives_of(settings, use)),
      problem_("opening " + bus_->name()) {
  if (static_cast<int>(drives_.size()) == kinematics_.wheel_count()) return;
  throw std::runtime_error{fmt::format("hal.cia402.nodes: {} drives for a base of {} wheels (base.wheel_angles_rad)",
                                       drives_.size(), kinematics_.wheel_count())};
}

void Drives::step(std::int64_t now_ns) {
  if (stopped_) return;
  if (!open_ && now_ns >= next_open_ns_) open(now_ns);
  if (open_) receive(now_ns);
  if (!open_) return;
  for (Drive& drive : drives_) drive.step(now_ns, out_);
  if (now_ns >= next_heartbeat_ns_) {
    next_heartbeat_ns_ = now_ns + kHeartbeat_ns;
    if (use_ == WheelsUse::kDrive) out_.push_back(heartbeat(settings_.master, NodeState::kOperational));
  }
  if (running() && now_ns >= next_cycle_ns_) cycle(now_ns);
  send(now_ns);
  if (now_ns - note_ns_ >= kNoteStands_ns) note_.clear();
}

std::int64_t Drives::next_ns() const {
  if (stopped_) return std::numeric_limits<std::int64_t>::max();
  if (!open_) return next_open_ns_;
  std::int64_t next_ns = next_heartbeat_ns_;
  for (const Drive& drive : drives_) next_ns = std::min(next_ns, drive.next_ns());
  return running() ? std::min(next_ns, next_cycle_ns_) : next_ns;
}

bool Drives::running() const { return std::ranges::any_of(drives_, &Drive::running); }

bool Drives::up() const {
  return open_ && std::ranges::all_of(drives_, use_ == WheelsUse::kDrive ? &Drive::enabled : &Drive::received);
}

void Drives::open(std::int64_t now_ns) {
  if (bus_->open(kNow) != Line::Opening::kOpen)
    return lose(fmt::format("no bus {}: {}", bus_->name(), bus_->why()), now_ns);
  open_ = true;
  problem_.clear();
  next_heartbeat_ns_ = next_cycle_ns_ = now_ns;
  for (Drive& drive : drives_) drive.open(now_ns, out_);
}

void Drives::receive(std::int64_t now_ns) {
  std::array<char, 256> bytes;
  for (int i = 0; i < kMostReads && open_; ++i) {
    const auto count = bus_->read(bytes, kNow);
    if (!count) return lose(fmt::format("{}: the bus is cut: {}", bus_->name(), bus_->why()), now_ns);
    if (*count == 0) return;
    for (const can::Frame& frame : can::decode({bytes.data(), *count})) {
      if (open_) take(frame, now_ns);
    }
  }
}

void Drives::take(const can::Frame& frame, std::int64_t now_ns) {
  if (can::is_bus_off(frame)) return lose(fmt::format("{}: {}", bus_->name(), can::describe_error(frame)), now_ns);
  if (frame.error) {
    note_ = can::describe_error(frame);
    note_ns_ = now_ns;
    return;
  }
  for (Drive& drive : drives_) drive.take(frame, now_ns, out_);
  finish_sample();
}

void Drives::finish_sample() {
  const bool whole =
      std::ranges::all_of(drives_, [](const Drive& drive) { return drive.running() && drive.answered(); });
  if (!sync_ns_ || !whole) return;
  sample_ = WheelSample{.t_ns = *std::exchange(sync_ns_, std::nullopt),
                        .wheel_count = kinematics_.wheel_count(),
                        .wheel_radps = {},
                        .gyro_radps = std::nullopt,
                        .emulated = settings_.port.find('/') != std::string::npos};  // no interface's name has one
  for (std::size_t i = 0; i < drives_.size(); ++i) sample_->wheel_radps[i] = drives_[i].wheel_radps();
}

void Drives::cycle(std::int64_t now_ns) {
  const std::int64_t cycle_ns = kicking::nanoseconds(settings_.cycle_s);
  next_cycle_ns_ = std::max(next_cycle_ns_ + cycle_ns, now_ns + cycle_ns / 2);
  sync_ns_ = now_ns;
  if (!up()) wheel_radps_ = {};  // what was asked for before is not done afterwards
  out_.push_back(sync());
  if (use_ == WheelsUse::kListen) return expect_answers(now_ns);
  const std::vector<double> rpm = motor_rpm();
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    if (drives_[i].running()) out_.push_back(drives_[i].command(rpm[i], now_ns));
  }
}

void Drives::expect_answers(std::int64_t now_ns) {
  for (Drive& drive : drives_) {
    if (drive.running()) drive.expect_answer(now_ns);
  }
}

/// Of each drive; scaled down as a whole where one would turn too fast.
std::vector<double> Drives::motor_rpm() const {
  std::vector<double> rpm(drives_.size(), 0.0);
  double fastest = 0.0;
  for (std::size_t i = 0; i < rpm.size() && up(); ++i) {
    rpm[i] = drives_[i].motor_rpm(wheel_radps_[i]);
    fastest = std::max(fastest, std::abs(rpm[i]));
  }
  if (!std::isfinite(fastest)) return std::vector<double>(drives_.size(), 0.0);
  for (double& speed : rpm) speed *= fastest > settings_.max_motor_rpm ? settings_.max_motor_rpm / fastest : 1.0;
  return rpm;
}

void Drives::drive(const kicking::Twist& set_point) {
  const bool finite =
      std::isfinite(set_point.vx_mps) && std::isfinite(set_point.vy_mps) && std::isfinite(set_point.omega_radps);
  wheel_radps_ = kinematics_.wheel_speeds_radps(finite ? set_point : kicking::Twist{});
}

void Drives::drive_wheel(int wheel, double radps) {
  wheel_radps_ = {};
  wheel_radps_.at(static_cast<std::size_t>(wheel)) = std::isfinite(radps) ? radps : 0.0;
}

void Drives::stop() noexcept {
  if (std::exchange(stopped_, true) || !open_ || use_ == WheelsUse::kListen) return;
  for (const Drive& drive : drives_) bus_->write(can::encode(drive.quick_stop()), kNow);
}

std::optional<WheelSample> Drives::take_sample() { return std::exchange(sample_, std::nullopt); }

void Drives::send(std::int64_t now_ns) {
  for (const can::Frame& frame : std::exchange(out_, {})) {
    if (open_ && !bus_->write(can::encode(frame), kNow))
      lose(fmt::format("{}: the bus is cut: {}", bus_->name(), bus_->why()), now_ns);
  }
}

void Drives::lose(const std::string& why, std::int64_t now_ns) {
  bus_->close();
  for (Drive& drive : drives_) drive.close();
  out_.clear();
  sync_ns_.reset();
  open_ = false;
  next_open_ns_ = now_ns + kOpenPause_ns;
  problem_ = why;
}

std::string Drives::status() const {
  if (!open_) return problem_;
  std::string text = bus_->name() + ": ";
  if (use_ == WheelsUse::kDrive && up()) {
    const Scale& scale = drives_.front().scale();
    text += fmt::format("{} drives in operation, {:g} rpm a unit, gear {:g}", drives_.size(), scale.rpm_per_unit,
                        scale.gear);
  } else {
    if (use_ == WheelsUse::kListen) text += "listened to, not driven: ";
    const char* comma = "";
    for (const Drive& drive : drives_) {
      if (const std::string said = drive.status(); !said.empty()) text += std::exchange(comma, "; ") + said;
    }
  }
  return note_.empty() ? text : text + "; the interface says: " + note_;
}

}  // namespace trivela::hal::cia402

namespace trivela::config {

std::unique_ptr<hal::Wheels> wheels_of(const Cia402Device& drives, const Hal&, const hal::Owner& owner,
                                       hal::WheelsUse use) {
  return std::make_unique<hal::cia402::Cia402Wheels>(
      hal::can::can_line(drives.port, use == hal::WheelsUse::kDrive ? "drives" : ""), drives, owner.base, use);
}

}  // namespace trivela::config
