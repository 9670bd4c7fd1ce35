#include "hal/cia402/drive.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "kicking/geometry/time.hpp"

namespace trivela::hal::cia402 {
namespace {

constexpr std::int64_t kStartPause_ns = 500'000'000;
constexpr std::int64_t kSettle_ns = 500'000'000;     // heartbeats that were sent before it was started
constexpr std::int64_t kResets_ns = 2'000'000'000;   // so long are faults reset while it comes up for the first time
constexpr std::int64_t kBeatsFlow_ns = 200'000'000;  // so long it has heard us again before its fault is reset
constexpr double kRpmOfRadps = 60.0 / (2.0 * std::numbers::pi);

}  // namespace

Drive::Drive(std::uint8_t node, bool reversed, const config::Cia402Device& settings, WheelsUse use)
    : node_(node),
      sign_(reversed ? -1.0 : 1.0),
      settings_(settings),
      use_(use),
      silence_ns_(kicking::nanoseconds(std::max(settings.heartbeat_s, 4.0 * settings.cycle_s))) {}

void Drive::open(std::int64_t now_ns, Frames& out) { start(now_ns, out); }

void Drive::start(std::int64_t now_ns, Frames& out) {
  start_up_.emplace(node_, settings_, was_enabled_ ? StartUp::Reset::kNo : StartUp::Reset::kYes, use_);
  stage_ = Stage::kStarting;
  ask(now_ns, out);
}

void Drive::ask(std::int64_t now_ns, Frames& out) {
  out.push_back(start_up_->request());
  due_ns_ = now_ns + start_up_->timeout_ns();
}

void Drive::go_on(StartUp::Progress progress, std::int64_t now_ns, Frames& out) {
  switch (progress) {
    case StartUp::Progress::kWaiting:
      return;
    case StartUp::Progress::kNext:
      return ask(now_ns, out);
    case StartUp::Progress::kFailed:
      problem_ = start_up_->why();
      stage_ = Stage::kPaused;
      due_ns_ = now_ns + kStartPause_ns;
      return;
    case StartUp::Progress::kDone:
      out.push_back(nmt(Nmt::kStart, node_));
      stage_ = Stage::kRunning;
      scale_ = start_up_->scale();
      running_ns_ = heartbeat_ns_ = asked_ns_ = now_ns;
      state_ = DriveState::kUnknown;
      controlword_ = 0;
      answered_ = asked_ = false;
      problem_.clear();
      note_error(start_up_->error_code());
  }
}

void Drive::note_error(std::uint16_t code) {
  if (code == 0) return;
  emergency_ = code;
  heartbeat_lost_ = heartbeat_lost_ || code == kHeartbeatLost;
  other_error_ = other_error_ || !is_of_the_link(code);
}

void Drive::take(const can::Frame& frame, std::int64_t now_ns, Frames& out) {
  if (const auto code = emergency_of(frame, node_)) {
    emergency_ = *code;
    note_error(*code);
  }
  if (heartbeat_of(frame, node_) == NodeState::kBootUp) {
    emergency_ = 0;
    heartbeat_lost_ = other_error_ = false;
  }
  if (stage_ == Stage::kStarting) return go_on(start_up_->take(frame), now_ns, out);
  if (stage_ != Stage::kRunning) return;
  if (const auto state = heartbeat_of(frame, node_)) return take_heartbeat(*state, now_ns, out);
  if (const auto pdo = tx_pdo_of(frame, node_)) take_pdo(*pdo, now_ns);
}

void Drive::take_heartbeat(NodeState state, std::int64_t now_ns, Frames& out) {
  if (state == NodeState::kBootUp) return lose("it has restarted by itself", now_ns, out);
  heartbeat_ns_ = now_ns;
  if (state != NodeState::kOperational && now_ns - running_ns_ > kSettle_ns)
    lose("it is not operational any more", now_ns, out);
}

void Drive::take_pdo(const TxPdo& pdo, std::int64_t now_ns) {
  answered_ = true;
  asked_ = false;
  velocity_ = pdo.velocity;
  const DriveState before = std::exchange(state_, state_of(pdo.statusword));
  if (state_ == DriveState::kFault && before != DriveState::kFault) fault_ns_ = now_ns;
  if (state_ == DriveState::kEnabled) {
    was_enabled_ = true;
    emergency_ = 0;
    heartbeat_lost_ = other_error_ = false;
  }
}

void Drive::step(std::int64_t now_ns, Frames& out) {
  if (stage_ == Stage::kStarting && now_ns >= due_ns_) go_on(start_up_->timed_out(), now_ns, out);
  if (stage_ == Stage::kPaused && now_ns >= due_ns_) start(now_ns, out);
  if (stage_ != Stage::kRunning) return;
  if (now_ns - heartbeat_ns_ >= silence_ns_)
    return lose(fmt::format("no heartbeat for {:g} s", kicking::seconds(silence_ns_)), now_ns, out);
  if (asked_ && now_ns - asked_ns_ >= silence_ns_)
    lose(fmt::format("no answer to SYNC for {:g} s", kicking::seconds(silence_ns_)), now_ns, out);
}

std::int64_t Drive::next_ns() const {
  if (stage_ == Stage::kClosed) return std::numeric_limits<std::int64_t>::max();
  if (stage_ != Stage::kRunning) return due_ns_;
  return (asked_ ? std::min(heartbeat_ns_, asked_ns_) : heartbeat_ns_) + silence_ns_;
}

void Drive::lose(const std::string& why, std::int64_t now_ns, Frames& out) {
  if (use_ == WheelsUse::kDrive) out.push_back(quick_stop());
  problem_ = state_ == DriveState::kFault ? fault() : why;
  stage_ = Stage::kPaused;
  due_ns_ = now_ns + kStartPause_ns;
}

double Drive::motor_rpm(double wheel_radps) const { return sign_ * wheel_radps * scale_.gear * kRpmOfRadps; }

double Drive::wheel_radps() const { return sign_ * velocity_ * scale_.rpm_per_unit / (scale_.gear * kRpmOfRadps); }

void Drive::expect_answer(std::int64_t now_ns) {
  answered_ = false;
  if (!std::exchange(asked_, true)) asked_ns_ = now_ns;
}

can::Frame Drive::command(double motor_rpm, std::int64_t now_ns) {
  constexpr double kMost = std::numeric_limits<std::int32_t>::max();
  const bool coming_up = !was_enabled_ && now_ns - running_ns_ < kResets_ns;
  const std::int64_t faulty_ns = state_ == DriveState::kFault ? now_ns - fault_ns_ : 0;
  const bool after_our_loss = lost_us() && faulty_ns < kBeatsFlow_ns + kResets_ns;
  may_reset_ = coming_up || after_our_loss;
  controlword_ = next_controlword(state_, coming_up || (after_our_loss && faulty_ns >= kBeatsFlow_ns), controlword_);
  expect_answer(now_ns);
  const double units = std::round(std::clamp(motor_rpm / scale_.rpm_per_unit, -kMost, kMost));
  return rx_pdo(node_, enabled() ? static_cast<std::int32_t>(units) : 0, controlword_);
}

std::string Drive::fault() const {
  return fmt::format("fault: {}{}", emergency_ != 0 ? emergency_words(emergency_) : "no emergency was received",
                     may_reset_ ? "" : "; start this program again to reset it");
}

std::string Drive::status() const {
  if (enabled() && use_ == WheelsUse::kDrive) return "";
  std::string text = "starting";
  if (!problem_.empty()) {
    text = problem_;
  } else if (running()) {
    const bool faulty = state_ == DriveState::kFault || state_ == DriveState::kFaultReaction;
    text = faulty ? fault() : std::string{name(state_)};
  }
  return fmt::format("drive {}: {}", node_, text);
}

}  // namespace trivela::hal::cia402
