#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "config/devices.hpp"
#include "hal/board/kicker_board.hpp"
#include "hal/line/line.hpp"
#include "hal/rekick/messages.hpp"

namespace trivela::hal::rekick {

/// The ReKick board. Where the bus is opened, and when the board was reset, it is told its voltage; it is asked for its
/// state every kPollPeriod_ns, again after kAnswer_ns where no answer came, and pinged every kPingPeriod_ns as by its
/// public host. Without an answer for kSilence_ns it is lost, and the bus is opened again between pauses.
///
/// A kick is one frame, at least kBetweenKicks_ns after the last; the public host sends each five times. A sample is of
/// the instant at which the board was asked. Armed: the supply of the kicker is on. Charge: the energy (V / Vmax)^2,
/// not cut off above 1. The board's error flag is KickerFault::kCharger.
class ReKick final : public KickerBoard {
 public:
  static constexpr std::int64_t kPollPeriod_ns = 20'000'000;
  static constexpr std::int64_t kPingPeriod_ns = 330'000'000;
  static constexpr std::int64_t kAnswer_ns = 100'000'000;
  static constexpr std::int64_t kSilence_ns = 300'000'000;
  static constexpr std::int64_t kBetweenKicks_ns = 100'000'000;

  ReKick(std::unique_ptr<Line> bus, const config::ReKickDevice& settings);

  void step(std::int64_t now_ns) override;
  std::int64_t next_ns() const override;
  int descriptor() const override { return bus_->descriptor(); }
  bool up() const override { return phase_ == Phase::kUp; }
  std::string shoot(double power, std::int64_t now_ns) override;
  std::string beyond(double power) const override;
  std::optional<KickerSample> take_sample() override;
  KickerCapabilities capabilities() const override {
    return {.charge_control = false, .voltage = true, .discharge = false, .watchdog = false};
  }
  const std::string& status() const override { return status_; }

 private:
  enum class Phase { kClosed, kAsking, kUp };

  std::int64_t question_due_ns() const;
  void open(std::int64_t now_ns);
  void receive(std::int64_t now_ns);
  void take(const can::Frame& frame, std::int64_t now_ns);
  void take_state(const State& state);
  void take_text(const can::Frame& frame);
  void ask_what_is_due(std::int64_t now_ns);
  void send(const can::Frame& frame, std::int64_t now_ns);
  void lose(const std::string& why, std::int64_t now_ns);
  void say_link_fault(std::int64_t now_ns);

  std::unique_ptr<Line> bus_;
  config::ReKickDevice settings_;
  Phase phase_ = Phase::kClosed;
  std::int64_t next_ns_ = 0;  // closed: the next opening; else: the next question
  std::int64_t next_ping_ns_ = 0;
  std::optional<std::int64_t> unanswered_since_ns_;  // the first question without an answer
  std::optional<std::int64_t> fault_said_ns_;
  std::optional<std::int64_t> last_kick_ns_;
  bool emulated_ = false;  // by its answer to the ping
  std::optional<KickerSample> sample_;
  std::string text_;  // of the board, up to the end of its line
  std::string status_;
};

}  // namespace trivela::hal::rekick
