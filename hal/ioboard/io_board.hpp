#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "config/devices.hpp"
#include "hal/board/kicker_board.hpp"
#include "hal/ioboard/frame.hpp"
#include "hal/line/line.hpp"

namespace trivela::hal::ioboard {

/// The Falcons' ioBoard. Where its line is opened it is asked for its version, told the lever's height once, and asked
/// for its switches every kPollPeriod_ns from then on. Of a robot with several kinds of kick it is told the height of
/// another kind when that is wanted and the lever stands: the board ignores a height while the lever moves, and does
/// not say how long that is. It is taken to take lever_s.
///
/// A question is asked again, kRetries times, where no answer comes within kAnswer_ns; then the line is lost, and
/// opened again between pauses. A shot and a height are never sent twice: the board may have done what it did not
/// answer to. What has not left the computer when an answer is due will not leave any more.
///
/// A sample is of the instant at which the board was asked, which is the earliest at which it can have looked. Armed:
/// both switches were closed in two answers running. The charge is modelled: the energy rises evenly from nothing to
/// the whole within charge_time_s of the last shot, or of the first answer on this line.
class IoBoard final : public KickerBoard {
 public:
  static constexpr std::int64_t kPollPeriod_ns = 20'000'000;
  static constexpr std::int64_t kAnswer_ns = 100'000'000;  ///< as the Falcons' host waits
  static constexpr int kRetries = 2;

  IoBoard(std::unique_ptr<Line> line, const config::IoBoardDevice& settings);

  void step(std::int64_t now_ns) override;
  std::int64_t next_ns() const override;
  int descriptor() const override { return line_->descriptor(); }
  bool up() const override { return phase_ == Phase::kUp; }
  std::string shoot(double power, std::int64_t now_ns) override;
  std::string beyond(double power) const override;
  std::optional<KickerSample> take_sample() override;
  void lever(std::uint8_t kick_kind) override;
  bool stands_for(std::uint8_t kick_kind, std::int64_t now_ns) const override {
    return settings_.levers.size() < 2 || lever_kind(now_ns) == kick_kind;
  }
  KickerCapabilities capabilities() const override { return {.lever = settings_.levers.size() > 1}; }
  const std::string& status() const override { return status_; }

 private:
  enum class Phase { kClosed, kOpening, kVersion, kHeight, kUp };
  struct Question {
    Frame frame;
    std::int64_t first_ns;  // asked at first
    std::int64_t last_ns;   // asked at last
    int asked;
  };

  void open(std::int64_t now_ns);
  void receive(std::int64_t now_ns);
  void take(const Frame& answer, std::int64_t now_ns);
  void take_version(const Frame& answer, std::int64_t now_ns);
  void take_switches(const Frame& answer, std::int64_t asked_ns);
  void refused(std::int64_t now_ns);
  void time_out(std::int64_t now_ns);
  void ask(const Frame& frame, std::int64_t now_ns);
  void send(const Frame& frame, std::int64_t now_ns);
  std::optional<std::uint8_t> height() const;
  void take_height(const Frame& answer, std::int64_t now_ns);
  std::uint8_t lever_kind(std::int64_t now_ns) const;
  void come_up(std::int64_t now_ns);
  void lose(const std::string& why, std::int64_t now_ns);
  void say_link_fault(std::int64_t now_ns);
  double charge(std::int64_t now_ns) const;

  std::unique_ptr<Line> line_;
  config::IoBoardDevice settings_;
  FrameParser parser_;
  Phase phase_ = Phase::kClosed;
  std::int64_t next_ns_ = 0;  // closed: the next opening; up: the next poll
  std::optional<std::int64_t> fault_said_ns_;
  std::optional<Question> question_;                // to be answered
  std::optional<std::int64_t> shot_unanswered_ns_;  // when it was sent
  bool closed_once_ = false;                        // both switches, in the last answer
  std::int64_t charging_since_ns_ = 0;
  std::uint8_t wanted_kind_ = 0;      // for which the lever shall stand
  std::uint8_t told_kind_ = 0;        // that the board was told last
  std::int64_t lever_stands_ns_ = 0;  // from then on it does
  std::optional<KickerSample> sample_;
  std::string version_;
  std::string status_;
};

/// The pulse's units of a set-point: power pulse_us_per_power / kPulseUnit_us, rounded. None: not within 0 to 255.
std::optional<std::uint8_t> pulse_of(double power, double pulse_us_per_power);

}  // namespace trivela::hal::ioboard
