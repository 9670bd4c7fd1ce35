#include "hal/cia402/start_up.hpp"

#include <fmt/core.h>

#include <cmath>

namespace trivela::hal::cia402 {
namespace {

constexpr std::int64_t kBootTimeout_ns = 3'000'000'000, kTimeout_ns = 250'000'000;
constexpr std::uint32_t kMaxon = 0xFB;  // whose drives without object 60A9 count in rpm
constexpr std::uint32_t kRpm = 0xB44700;
constexpr int kGreatestPower = 6;
constexpr std::uint32_t kNotValid = 0x80000000, kNoRemoteRequest = 0x40000000;
constexpr std::uint32_t kQuickStopThenDisabled = 2, kLinkLostQuickStop = 3, kProfileVelocity = 3;
constexpr std::uint8_t kAtOnce = 0xFF, kEachSync = 1;
constexpr std::uint16_t kProducerPeriod_ms = 50;

constexpr Object kVendor{0x1018, 1}, kConsumerHeartbeat{0x1016, 1}, kProducerHeartbeat{0x1017, 0},
    kVelocityUnit{0x60A9, 0}, kGearMotor{0x6091, 1}, kGearShaft{0x6091, 2}, kLinkLost{0x6007, 0},
    kQuickStopCode{0x605A, 0}, kMode{0x6060, 0}, kRampUp{0x6083, 0}, kRampDown{0x6084, 0}, kQuickStopRamp{0x6085, 0},
    kErrorCode{0x603F, 0};

}  // namespace

std::optional<double> rpm_per_unit_of(std::uint32_t object_60a9) {
  const int power = static_cast<std::int32_t>(object_60a9) >> 24;  // two's complement, since C++20
  if ((object_60a9 & 0xFFFFFFU) != kRpm || std::abs(power) > kGreatestPower) return std::nullopt;
  return std::pow(10.0, power);
}

StartUp::StartUp(std::uint8_t node, const config::Cia402Device& settings, Reset reset, WheelsUse use)
    : node_(node),
      reset_(use == WheelsUse::kListen ? Reset::kNo : reset),
      consumer_heartbeat_(std::uint32_t{settings.master} << 16U |
                          static_cast<std::uint32_t>(std::lround(settings.heartbeat_s * 1e3))) {
  add_reads(settings);
  const std::uint32_t id = node;
  if (use == WheelsUse::kListen) {
    tasks_.push_back({.object = kProducerHeartbeat, .size = 2, .value = kProducerPeriod_ms});
  } else {
    add_settings(settings);
    add_mapping(0x1400, 0x1600, kRxPdo1 + id, kAtOnce, {0x60FF0020, 0x60400010});
  }
  add_mapping(0x1800, 0x1A00, (kTxPdo1 + id) | kNoRemoteRequest, kEachSync, {0x606C0020, 0x60780010, 0x60410010});
}

void StartUp::add_reads(const config::Cia402Device& settings) {
  if (settings.rpm_per_unit) {
    scale_.rpm_per_unit = *settings.rpm_per_unit;
  } else {
    tasks_.push_back({.object = kVendor});
    tasks_.push_back({.object = kVelocityUnit, .may_be_missing = true});
  }
  if (settings.gear) {
    scale_.gear = *settings.gear;
  } else {
    tasks_.push_back({.object = kGearMotor, .may_be_missing = true});
    tasks_.push_back({.object = kGearShaft, .may_be_missing = true});
  }
  if (reset_ == Reset::kNo) tasks_.push_back({.object = kErrorCode, .may_be_missing = true});
}

void StartUp::add_settings(const config::Cia402Device& settings) {
  tasks_.push_back({.object = kConsumerHeartbeat,
                    .value = consumer_heartbeat_,
                    .because = ": its wheel would turn on when this program dies"});
  tasks_.push_back({.object = kConsumerHeartbeat});
  tasks_.push_back({.object = kLinkLost,
                    .size = 2,
                    .value = kLinkLostQuickStop,
                    .because = ": it may turn on when this program dies"});
  tasks_.push_back({.object = kQuickStopCode, .size = 2, .value = kQuickStopThenDisabled});
  tasks_.push_back({.object = kProducerHeartbeat, .size = 2, .value = kProducerPeriod_ms});
  tasks_.push_back(
      {.object = kMode, .size = 1, .value = kProfileVelocity, .because = ": it knows no profile velocity"});
  if (settings.ramp) {
    tasks_.push_back({.object = kRampUp, .value = *settings.ramp});
    tasks_.push_back({.object = kRampDown, .value = *settings.ramp});
  }
  if (settings.quick_stop_ramp) tasks_.push_back({.object = kQuickStopRamp, .value = *settings.quick_stop_ramp});
}

/// A PDO is mapped while it is not valid.
void StartUp::add_mapping(std::uint16_t communication, std::uint16_t mapping, std::uint32_t id,
                          std::uint8_t transmission, const std::vector<std::uint32_t>& objects) {
  tasks_.push_back({.object = {communication, 1}, .value = id | kNotValid});
  tasks_.push_back({.object = {communication, 2}, .size = 1, .value = transmission});
  tasks_.push_back({.object = {mapping, 0}, .size = 1, .value = 0});
  for (std::size_t i = 0; i < objects.size(); ++i)
    tasks_.push_back({.object = {mapping, static_cast<std::uint8_t>(i + 1)}, .value = objects[i]});
  tasks_.push_back({.object = {mapping, 0}, .size = 1, .value = static_cast<std::uint32_t>(objects.size())});
  tasks_.push_back({.object = {communication, 1}, .value = id});
}

const StartUp::Task* StartUp::task() const { return up_ && next_ < tasks_.size() ? &tasks_[next_] : nullptr; }

can::Frame StartUp::request() const {
  const Task* const open = task();
  if (open == nullptr) return nmt(reset_ == Reset::kYes ? Nmt::kReset : Nmt::kPreOperational, node_);
  return open->value ? sdo_write(node_, open->object, *open->value, open->size) : sdo_read(node_, open->object);
}

std::int64_t StartUp::timeout_ns() const { return !up_ && reset_ == Reset::kYes ? kBootTimeout_ns : kTimeout_ns; }

StartUp::Progress StartUp::take(const can::Frame& frame) {
  if (const auto state = heartbeat_of(frame, node_)) {
    const bool quiet = reset_ == Reset::kNo && state == NodeState::kPreOperational;
    if (state != NodeState::kBootUp && (up_ || !quiet)) return Progress::kWaiting;
    up_ = true;
    next_ = 0;
    repeated_ = false;
    return Progress::kNext;
  }
  const auto reply = sdo_reply_of(frame, node_);
  const Task* const open = task();
  if (!reply || open == nullptr || !(reply->object == open->object)) return Progress::kWaiting;
  return take_reply(*reply);
}

StartUp::Progress StartUp::take_reply(const SdoReply& reply) {
  const Task& open = *task();
  if (reply.kind == SdoReply::Kind::kAborted && !open.may_be_missing)
    return fail(
        fmt::format("it refuses object {:04X}: {}{}", open.object.index, abort_words(reply.value), open.because));
  if (open.value) return reply.kind == SdoReply::Kind::kWritten ? go_on() : Progress::kWaiting;
  if (reply.kind == SdoReply::Kind::kWritten) return Progress::kWaiting;
  const bool read = reply.kind == SdoReply::Kind::kRead;
  const std::string wrong = take_value(open.object, read ? std::optional{reply.value} : std::nullopt);
  return wrong.empty() ? go_on() : fail(wrong);
}

/// Empty: it will do.
std::string StartUp::take_value(const Object& object, std::optional<std::uint32_t> value) {
  if (object == kVendor) {
    vendor_ = value;
  } else if (object == kVelocityUnit) {
    return take_unit(value);
  } else if (object == kErrorCode) {
    error_code_ = static_cast<std::uint16_t>(value.value_or(0));
  } else if (object == kGearMotor) {
    gear_numerator_ = value.value_or(0);
  } else if (object == kGearShaft) {
    if (gear_numerator_ == 0 || value.value_or(0) == 0)
      return "it does not know its gear (object 6091): set hal.cia402.gear";
    scale_.gear = static_cast<double>(gear_numerator_) / static_cast<double>(*value);
  } else if (object == kConsumerHeartbeat) {
    return check_heartbeat(value.value_or(0));
  }
  return "";
}

std::string StartUp::take_unit(std::optional<std::uint32_t> unit) {
  if (!unit && vendor_ == kMaxon) return "";
  const auto rpm = unit ? rpm_per_unit_of(*unit) : std::nullopt;
  if (rpm) scale_.rpm_per_unit = *rpm;
  if (rpm) return "";
  const std::string what = unit ? fmt::format("its unit of velocity (object 60A9) is {:08X}, not rpm", *unit)
                                : "it does not say its unit of velocity (object 60A9)";
  return what + ": set hal.cia402.rpm_per_unit";
}

std::string StartUp::check_heartbeat(std::uint32_t value) const {
  if (value == consumer_heartbeat_) return "";
  return fmt::format(
      "it does not keep the heartbeat that it is to watch (object 1016 is {:08X}, not {:08X}): its wheel would turn on "
      "when this program dies",
      value, consumer_heartbeat_);
}

StartUp::Progress StartUp::timed_out() {
  if (!up_ && reset_ == Reset::kNo) {  // its heartbeat may be off
    up_ = true;
    return Progress::kNext;
  }
  const Task* const open = task();
  if (open == nullptr) return fail("it does not come up after a reset");
  if (repeated_) return fail(fmt::format("no answer to object {:04X}", open->object.index));
  repeated_ = true;
  return Progress::kNext;
}

StartUp::Progress StartUp::go_on() {
  repeated_ = false;
  return ++next_ == tasks_.size() ? Progress::kDone : Progress::kNext;
}

StartUp::Progress StartUp::fail(const std::string& why) {
  why_ = why;
  return Progress::kFailed;
}

}  // namespace trivela::hal::cia402
