#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "hal/kicker.hpp"

namespace trivela::hal {

/// The board of a kicker at the end of its line, for the thread of a BoardKicker. It looks at no clock and never waits:
/// now_ns is the steady clock's.
class KickerBoard {
 public:
  /// A question that has waited so long for its answer makes a line doubtful: what is written to it may lie there and
  /// come out when nobody wants it any more. No shot is.
  static constexpr std::int64_t kDoubt_ns = 30'000'000;

  virtual ~KickerBoard() = default;

  /// Opens the line where it is closed, takes what has come and asks what is due.
  virtual void step(std::int64_t now_ns) = 0;

  /// When step() is to be called though nothing comes.
  virtual std::int64_t next_ns() const = 0;

  /// Readable when something has come; -1: the line is closed.
  virtual int descriptor() const = 0;

  /// It answers: a shot can be sent.
  virtual bool up() const = 0;

  /// Sends the shot now, by one write, which is never made again. Empty: it is on its way; else why not:
  /// also that the line has been doubtful for kDoubt_ns.
  virtual std::string shoot(double power, std::int64_t now_ns) = 0;

  /// Kicker::lever(): the next step() tells the board.
  virtual void lever(std::uint8_t kick_kind) { static_cast<void>(kick_kind); }

  /// Whether the lever stands for that kind of kick now. A board without a lever says yes.
  virtual bool stands_for(std::uint8_t kick_kind, std::int64_t now_ns) const {
    static_cast<void>(now_ns);
    return static_cast<void>(kick_kind), true;
  }

  /// Kicker::beyond(). For any thread.
  virtual std::string beyond(double power) const = 0;

  /// The newest sample that was not taken yet. While the line is down they say KickerFault::kLink.
  virtual std::optional<KickerSample> take_sample() = 0;

  virtual KickerCapabilities capabilities() const = 0;

  /// Kicker::status() of the line.
  virtual const std::string& status() const = 0;
};

}  // namespace trivela::hal
