#include "hal/rekick/rekick.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <utility>

#include "hal/board/board_kicker.hpp"
#include "hal/can/can_line.hpp"
#include "hal/open.hpp"
#include "kicking/geometry/time.hpp"

namespace trivela::hal::rekick {
namespace {

constexpr std::int64_t kPause_ns = 200'000'000;       // between two openings
constexpr std::int64_t kFaultPeriod_ns = 50'000'000;  // of samples while the board is lost
constexpr int kReadsPerStep = 64;                     // so that a flood keeps no kick waiting
constexpr std::size_t kLongestText = 200;
constexpr Line::Deadline kAtOnce{};  // does not wait

}  // namespace

ReKick::ReKick(std::unique_ptr<Line> bus, const config::ReKickDevice& settings)
    : bus_(std::move(bus)), settings_(settings), status_("opening " + bus_->name()) {}

void ReKick::step(std::int64_t now_ns) {
  if (phase_ == Phase::kClosed && now_ns >= next_ns_) open(now_ns);
  if (phase_ != Phase::kClosed) receive(now_ns);
  if (phase_ != Phase::kClosed) ask_what_is_due(now_ns);
  if (!up()) say_link_fault(now_ns);
}

/// An answer makes the next question due a period after the last one.
std::int64_t ReKick::question_due_ns() const {
  return unanswered_since_ns_ ? next_ns_ - kPollPeriod_ns + kAnswer_ns : next_ns_;
}

std::int64_t ReKick::next_ns() const {
  const std::int64_t due = question_due_ns();
  const std::int64_t ping = phase_ == Phase::kClosed ? due : next_ping_ns_;
  const std::int64_t fault = fault_said_ns_ ? *fault_said_ns_ + kFaultPeriod_ns : due;
  return std::min({due, ping, fault});
}

std::string ReKick::beyond(double power) const {
  if (pulse_of(power, settings_.pulse_us_per_power)) return {};
  return fmt::format("set-point {:g} is a pulse of {:g} us, the board's are 1 to {:g}", power,
                     power * settings_.pulse_us_per_power, kLongestPulse_us);
}

std::string ReKick::shoot(double power, std::int64_t now_ns) {
  const auto pulse_us = pulse_of(power, settings_.pulse_us_per_power);
  if (!pulse_us) return beyond(power);
  if (last_kick_ns_ && now_ns - *last_kick_ns_ < kBetweenKicks_ns) return "the last kick was less than 0.1 s before";
  if (unanswered_since_ns_ && now_ns - *unanswered_since_ns_ > kDoubt_ns)
    return fmt::format("the board has not answered for {:.0f} ms",
                       1e3 * kicking::seconds(*unanswered_since_ns_, now_ns));
  last_kick_ns_ = now_ns;
  send(kick(*pulse_us), now_ns);
  return up() ? std::string{} : status_;
}

std::optional<KickerSample> ReKick::take_sample() { return std::exchange(sample_, std::nullopt); }

void ReKick::open(std::int64_t now_ns) {
  if (bus_->open(kAtOnce) != Line::Opening::kOpen)
    return lose(fmt::format("no bus {}: {}", bus_->name(), bus_->why()), now_ns);
  phase_ = Phase::kAsking;
  emulated_ = false;
  unanswered_since_ns_.reset();
  next_ns_ = next_ping_ns_ = now_ns;
  text_.clear();
  send(max_voltage(settings_.max_voltage_v), now_ns);
}

void ReKick::receive(std::int64_t now_ns) {
  std::array<char, 256> bytes;
  for (int i = 0; i < kReadsPerStep && phase_ != Phase::kClosed; ++i) {
    const auto count = bus_->read(bytes, kAtOnce);
    if (!count) return lose(fmt::format("{}: the bus is cut: {}", bus_->name(), bus_->why()), now_ns);
    if (*count == 0) return;
    for (const can::Frame& frame : can::decode({bytes.data(), *count})) {
      if (phase_ != Phase::kClosed) take(frame, now_ns);
    }
  }
}

void ReKick::take(const can::Frame& frame, std::int64_t now_ns) {
  if (can::is_bus_off(frame)) return lose(fmt::format("{}: {}", bus_->name(), can::describe_error(frame)), now_ns);
  if (frame.error) {
    status_ = fmt::format("{}: {}", bus_->name(), can::describe_error(frame));
    return;
  }
  if (const auto state = state_of(frame)) return take_state(*state);
  if (is_emulated_pong(frame)) emulated_ = true;
  const auto answer = answer_of(frame);
  if (answer == Command::kReset) {
    status_ = fmt::format("{}: the board was reset: {}", bus_->name(), reset_cause(frame));
    send(max_voltage(settings_.max_voltage_v), now_ns);
  } else if (answer == Command::kError || answer == Command::kWarning) {
    take_text(frame);
  }
}

void ReKick::take_state(const State& state) {
  if (!unanswered_since_ns_) return;  // a second answer, to a question that was asked again
  const std::int64_t asked_ns = *std::exchange(unanswered_since_ns_, std::nullopt);
  if (phase_ == Phase::kAsking) {
    phase_ = Phase::kUp;
    fault_said_ns_.reset();
    status_ = bus_->name() + ": ReKick";
  }
  const double ratio = state.capacitor_v / settings_.max_voltage_v;
  sample_ = KickerSample{.t_ns = asked_ns,
                         .charge = ratio * ratio,
                         .armed = state.supply_on,
                         .fault = state.error ? KickerFault::kCharger : KickerFault::kNone,
                         .charge_modelled = false,
                         .voltage_v = state.capacitor_v,
                         .emulated = emulated_};
}

/// Texts come in pieces of seven characters and end with a line.
void ReKick::take_text(const can::Frame& frame) {
  for (const std::uint8_t byte : frame.payload().subspan(1)) {
    if (byte == '\n') {
      status_ = fmt::format("{}: the board says: {}", bus_->name(), std::exchange(text_, {}));
    } else if (byte >= ' ' && byte <= '~' && text_.size() < kLongestText) {
      text_ += static_cast<char>(byte);
    }
  }
}

void ReKick::ask_what_is_due(std::int64_t now_ns) {
  if (unanswered_since_ns_ && now_ns - *unanswered_since_ns_ >= kSilence_ns)
    return lose(bus_->name() + ": the board does not answer", now_ns);
  if (now_ns >= next_ping_ns_) {
    next_ping_ns_ = now_ns + kPingPeriod_ns;
    send(ask(Command::kPing), now_ns);
  }
  if (phase_ == Phase::kClosed || now_ns < question_due_ns()) return;
  next_ns_ = now_ns + kPollPeriod_ns;
  if (!unanswered_since_ns_) unanswered_since_ns_ = now_ns;
  send(ask(Command::kGetState), now_ns);
}

void ReKick::send(const can::Frame& frame, std::int64_t now_ns) {
  if (phase_ != Phase::kClosed && !bus_->write(can::encode(frame), kAtOnce))
    lose(fmt::format("{}: the bus is cut: {}", bus_->name(), bus_->why()), now_ns);
}

void ReKick::lose(const std::string& why, std::int64_t now_ns) {
  bus_->close();
  unanswered_since_ns_.reset();
  fault_said_ns_.reset();
  phase_ = Phase::kClosed;
  next_ns_ = now_ns + kPause_ns;
  status_ = why;
}

void ReKick::say_link_fault(std::int64_t now_ns) {
  if (fault_said_ns_ && now_ns < *fault_said_ns_ + kFaultPeriod_ns) return;
  fault_said_ns_ = now_ns;
  sample_ = KickerSample{.t_ns = now_ns, .charge = 0.0, .armed = false, .fault = KickerFault::kLink};
}

}  // namespace trivela::hal::rekick

namespace trivela::config {

std::unique_ptr<hal::Kicker> kicker_of(const ReKickDevice& board, const Hal&, const hal::Owner&) {
  return std::make_unique<hal::BoardKicker>(
      std::make_unique<hal::rekick::ReKick>(hal::can::can_line(board.port, "kicker"), board));
}

}  // namespace trivela::config
