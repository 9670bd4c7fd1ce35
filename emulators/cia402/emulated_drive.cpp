#include "emulators/cia402/emulated_drive.hpp"

namespace trivela::hal::cia402 {
namespace {

constexpr std::int64_t kMs_ns = 1'000'000;
constexpr std::uint32_t kInvalidPdo = 0x80000000;
constexpr std::uint8_t kErrorCommunication = 0x11, kErrorGeneric = 0x01;
constexpr std::uint16_t kPdoLength = 0x8220;
constexpr double kCoastRamp_rpmps = 3000.0;  // without voltage

constexpr Object kTarget{0x60FF, 0}, kControlword{0x6040, 0}, kStatusword{0x6041, 0}, kActual{0x606C, 0},
    kModeOfOperation{0x6060, 0}, kAcceleration{0x6083, 0}, kDeceleration{0x6084, 0}, kQuickStopDeceleration{0x6085, 0},
    kHeartbeatConsumer{0x1016, 1}, kHeartbeatProducer{0x1017, 0}, kLinkLostCode{0x6007, 0}, kLastError{0x603F, 0};

/// The ramps are those of a real configuration (Node_1.dcf), the rest what a drive has when it leaves its factory.
EmulatedDrive::Dictionary epos2(std::uint32_t node) {
  const auto at = [](std::uint16_t index, std::uint8_t sub) { return EmulatedDrive::key({index, sub}); };
  EmulatedDrive::Dictionary objects{
      {at(0x1018, 1), {0xFB, 4}},       {at(0x1016, 1), {0, 4}},
      {at(0x1017, 0), {0, 2}},          {at(0x6007, 0), {3, 2}},
      {at(0x605A, 0), {2, 2}},          {at(0x6060, 0), {1, 1}},
      {at(0x6040, 0), {0, 2}},          {at(0x6041, 0), {0, 2}},
      {at(0x603F, 0), {0, 2}},          {at(0x606C, 0), {0, 4}},
      {at(0x6078, 0), {0, 2}},          {at(0x60FF, 0), {0, 4}},
      {at(0x6083, 0), {10000, 4}},      {at(0x6084, 0), {10000, 4}},
      {at(0x6085, 0), {10000, 4}},      {at(0x1400, 1), {kRxPdo1 + node, 4}},
      {at(0x1400, 2), {255, 1}},        {at(0x1600, 0), {1, 1}},
      {at(0x1600, 1), {0x60400010, 4}}, {at(0x1800, 1), {0x40000000U + kTxPdo1 + node, 4}},
      {at(0x1800, 2), {255, 1}},        {at(0x1A00, 0), {1, 1}},
      {at(0x1A00, 1), {0x60410010, 4}}};
  for (const std::uint16_t mapping : {std::uint16_t{0x1600}, std::uint16_t{0x1A00}}) {
    for (std::uint8_t sub = 2; sub <= 8; ++sub) objects[at(mapping, sub)] = {0, 4};
  }
  return objects;
}

}  // namespace

EmulatedDrive::EmulatedDrive(std::uint8_t node) : factory(epos2(node)), node_(node), objects_(factory) {}

std::uint32_t EmulatedDrive::value(Object object) const {
  const auto found = objects_.find(key(object));
  return found == objects_.end() ? 0 : found->second.value;
}

std::int32_t EmulatedDrive::target_rpm() const { return static_cast<std::int32_t>(value(kTarget)); }

bool EmulatedDrive::pdo_valid(std::uint16_t communication) const {
  return (value({communication, 1}) & kInvalidPdo) == 0;
}

void EmulatedDrive::say(const can::Frame& frame, Frames& out) const {
  if (!faults.silent) out.push_back(frame);
}

void EmulatedDrive::boot(std::int64_t now_ns) {
  motor_.turn(0.0, kCoastRamp_rpmps, now_ns);
  objects_ = factory;
  nmt_ = NodeState::kBootUp;
  state_ = DriveState::kNotReady;
  controlword_ = 0;
  watching_ = false;
  boot_ns_ = now_ns + kBootTime_ns;
}

void EmulatedDrive::take(const can::Frame& frame, std::int64_t now_ns, Frames& out) {
  if (faults.deaf || frame.extended || frame.error) return;
  settle(now_ns);
  if (frame.id == kNmt) return take_nmt(frame, now_ns);
  if (boot_ns_) return;
  if (frame.id == kSync && frame.size == 0) return answer_sync(now_ns, out);
  if (frame.id == kRxPdo1 + node_) return take_pdo(frame, now_ns, out);
  if (const auto request = sdo_request_of(frame, node_)) return take_sdo(*request, now_ns, out);
  const std::uint32_t consumed = value(kHeartbeatConsumer);
  const auto master = static_cast<std::uint8_t>(consumed >> 16U & 0x7FU);
  if ((consumed & 0xFFFFU) != 0 && heartbeat_of(frame, master)) {
    watching_ = true;
    received_ns_ = now_ns;
  }
}

void EmulatedDrive::take_nmt(const can::Frame& frame, std::int64_t now_ns) {
  if (frame.size != 2 || (frame.data[1] != 0 && frame.data[1] != node_)) return;
  const auto command = static_cast<Nmt>(frame.data[0]);
  if (command == Nmt::kReset) return boot(now_ns);
  if (boot_ns_) return;
  if (command == Nmt::kStart) nmt_ = NodeState::kOperational;
  if (command == Nmt::kStop) nmt_ = NodeState::kStopped;
  if (command == Nmt::kPreOperational) nmt_ = NodeState::kPreOperational;
}

void EmulatedDrive::take_sdo(const SdoRequest& request, std::int64_t now_ns, Frames& out) {
  if (nmt_ == NodeState::kStopped) return;
  if (const std::uint32_t code = refusal(request)) return say(sdo_abort(node_, request.object, code), out);
  if (!request.write)
    return say(sdo_value(node_, request.object, read(request.object, now_ns), objects_[key(request.object)].size), out);
  write(request.object, *request.write, now_ns);
  say(sdo_written(node_, request.object), out);
}

/// 0: it is done.
std::uint32_t EmulatedDrive::refusal(const SdoRequest& request) const {
  const Object& object = request.object;
  const auto found = objects_.find(key(object));
  if (found == objects_.end() || (faults.refuses_heartbeat && object == kHeartbeatConsumer)) return kNoSuchObject;
  if (!request.write) return 0;
  if (request.size != found->second.size) return kWrongSize;
  const bool of_mapping = object.index == 0x1600 || object.index == 0x1A00;
  const auto communication = static_cast<std::uint16_t>(object.index - 0x200);
  if (of_mapping && (pdo_valid(communication) || nmt_ == NodeState::kOperational)) return kNotInThisState;
  if (object == kModeOfOperation && request.write != 3U) return kOutOfRange;
  return 0;
}

std::uint32_t EmulatedDrive::read(Object object, std::int64_t now_ns) const {
  if (object == kStatusword) return statusword_of(state_);
  if (object == kActual) return static_cast<std::uint32_t>(std::lround(measured_rpm.value_or(motor_.rpm(now_ns))));
  return value(object);
}

void EmulatedDrive::write(Object object, std::uint32_t value, std::int64_t now_ns) {
  if (faults.forgets_heartbeat && object == kHeartbeatConsumer) return;
  objects_[key(object)].value = value;
  if (object == kControlword) control(static_cast<std::uint16_t>(value), now_ns);
  if (object == kHeartbeatProducer) heartbeat_ns_ = now_ns;
  if (object == kHeartbeatConsumer) watching_ = false;  // until it hears one
  if (object == kTarget && state_ == DriveState::kEnabled) {
    const bool faster = std::abs(target_rpm()) > std::abs(motor_.rpm(now_ns));
    motor_.turn(target_rpm(), this->value(faster ? kAcceleration : kDeceleration), now_ns);
  }
}

void EmulatedDrive::take_pdo(const can::Frame& frame, std::int64_t now_ns, Frames& out) {
  if (nmt_ != NodeState::kOperational || !pdo_valid(0x1400)) return;
  std::size_t begin = 0;
  const auto objects = static_cast<std::uint8_t>(value({0x1600, 0}));
  for (std::uint8_t sub = 1; sub <= objects; ++sub) {
    const std::uint32_t mapped = value({0x1600, sub});
    const std::size_t size = (mapped & 0xFFU) / 8;
    if (begin + size > frame.size) return say(emergency(node_, kPdoLength, kErrorCommunication), out);
    write({static_cast<std::uint16_t>(mapped >> 16U), static_cast<std::uint8_t>(mapped >> 8U & 0xFFU)},
          number_at(frame, begin, size), now_ns);
    begin += size;
  }
}

void EmulatedDrive::answer_sync(std::int64_t now_ns, Frames& out) {
  if (nmt_ != NodeState::kOperational || !pdo_valid(0x1800) || value({0x1800, 2}) != 1) return;
  can::Frame frame{.id = kTxPdo1 + node_, .extended = false, .error = false, .size = 0, .data = {}};
  const auto objects = static_cast<std::uint8_t>(value({0x1A00, 0}));
  for (std::uint8_t sub = 1; sub <= objects; ++sub) {
    const std::uint32_t mapped = value({0x1A00, sub});
    const std::size_t size = (mapped & 0xFFU) / 8;
    if (frame.size + size > frame.data.size()) return;
    const Object object{static_cast<std::uint16_t>(mapped >> 16U), static_cast<std::uint8_t>(mapped >> 8U & 0xFFU)};
    put(frame, frame.size, read(object, now_ns), size);
    frame.size = static_cast<std::uint8_t>(frame.size + size);
  }
  ++answers_;
  say(frame, out);
}

void EmulatedDrive::control(std::uint16_t controlword, std::int64_t now_ns) {
  const bool reset = (controlword & kFaultReset) != 0 && (controlword_ & kFaultReset) == 0;
  controlword_ = controlword;
  if (state_ == DriveState::kFault || state_ == DriveState::kFaultReaction) {
    if (!reset || state_ == DriveState::kFaultReaction) return;
    ++resets_;
    state_ = DriveState::kSwitchOnDisabled;
    return;
  }
  if (state_ == DriveState::kNotReady) return;
  const bool moves = state_ == DriveState::kEnabled || state_ == DriveState::kQuickStop;
  const auto command = controlword & 0x0FU;
  if ((command & 0x02U) == 0) {  // disable voltage
    if (moves) motor_.turn(0.0, kCoastRamp_rpmps, now_ns);
    state_ = DriveState::kSwitchOnDisabled;
  } else if ((command & 0x04U) == 0) {  // quick stop
    if (moves) motor_.turn(0.0, value(kQuickStopDeceleration), now_ns);
    state_ = moves ? DriveState::kQuickStop : DriveState::kSwitchOnDisabled;
  } else {
    step_up(command, now_ns);
  }
}

/// Towards operation one state at a time, and back at once.
void EmulatedDrive::step_up(unsigned command, std::int64_t now_ns) {
  const bool enabled = state_ == DriveState::kEnabled;
  if (enabled && command != kEnableOperation) motor_.turn(0.0, kCoastRamp_rpmps, now_ns);
  if (command == kShutdown) {
    state_ = DriveState::kReady;
  } else if (command == kSwitchOn) {
    if (enabled || state_ == DriveState::kReady) state_ = DriveState::kSwitchedOn;
  } else if (command == kEnableOperation && value(kModeOfOperation) == 3) {
    if (state_ == DriveState::kSwitchedOn) state_ = DriveState::kEnabled;
  }
}

/// A quick stop, or a fault's, is over when the motor stands.
void EmulatedDrive::settle(std::int64_t now_ns) {
  const auto rest_ns = motor_.rest_ns();
  if (!rest_ns || now_ns < *rest_ns) return;
  if (state_ == DriveState::kQuickStop) state_ = DriveState::kSwitchOnDisabled;
  if (state_ == DriveState::kFaultReaction) state_ = DriveState::kFault;
}

void EmulatedDrive::fail(std::uint16_t code, std::int64_t now_ns, Frames& out) {
  motor_.turn(0.0, value(kQuickStopDeceleration), now_ns);
  state_ = DriveState::kFaultReaction;
  objects_[key(kTarget)].value = 0;
  if (const auto error = objects_.find(key(kLastError)); error != objects_.end()) error->second.value = code;
  say(emergency(node_, code, code == kHeartbeatLost ? kErrorCommunication : kErrorGeneric), out);
}

std::int64_t EmulatedDrive::consumer_due_ns() const {
  const auto period_ms = static_cast<std::int64_t>(value(kHeartbeatConsumer) & 0xFFFFU);
  return watching_ && period_ms != 0 ? received_ns_ + period_ms * kMs_ns : kNever_ns;
}

/// What it does is that of the instant at which the heartbeat was missing.
void EmulatedDrive::lose_master(Frames& out) {
  const std::int64_t then_ns = consumer_due_ns();
  watching_ = false;
  if (value(kLinkLostCode) == 3) return fail(kHeartbeatLost, then_ns, out);
  say(emergency(node_, kHeartbeatLost, kErrorCommunication), out);
}

void EmulatedDrive::tick(std::int64_t now_ns, Frames& out) {
  if (boot_ns_ && now_ns >= *boot_ns_) {
    boot_ns_.reset();
    ++boots_;
    nmt_ = NodeState::kPreOperational;
    state_ = DriveState::kSwitchOnDisabled;
    say(heartbeat(node_, NodeState::kBootUp), out);
  }
  if (now_ns >= consumer_due_ns()) lose_master(out);
  settle(now_ns);
  const std::int64_t period_ns = value(kHeartbeatProducer) * kMs_ns;
  if (boot_ns_ || period_ns == 0 || now_ns < heartbeat_ns_ + period_ns) return;
  heartbeat_ns_ = now_ns;
  say(heartbeat(node_, nmt_), out);
}

std::int64_t EmulatedDrive::next_ns() const {
  if (boot_ns_) return *boot_ns_;
  const std::int64_t period_ns = value(kHeartbeatProducer) * kMs_ns;
  return std::min(period_ns == 0 ? kNever_ns : heartbeat_ns_ + period_ns, consumer_due_ns());
}

}  // namespace trivela::hal::cia402
