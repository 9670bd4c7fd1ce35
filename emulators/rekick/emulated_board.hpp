#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "emulators/line/emulator.hpp"
#include "hal/rekick/messages.hpp"

namespace trivela::hal::rekick {

/// What an emulated board is told to do wrong.
struct EmulatedFaults {
  bool silent = false;
  bool error = false;     ///< its error flag
  int lost_every = 0;     ///< each such answer is not sent
  int foreign_every = 0;  ///< before each such answer another device of the bus speaks
};

/// The behaviour of a ReKick board, as far as its host's source tells it; the firmware is not public. Assumed: the
/// capacitor's energy rises evenly within kChargeTime_s to that of the voltage that was ordered, from nothing at the
/// start; a pulse takes the part of it that its length is of the longest, and one under way ignores another.
class EmulatedBoard final : public EmulatedDevice {
 public:
  static constexpr double kChargeTime_s = 3.0;

  struct Pulse {
    std::int64_t t_ns;  ///< when the order was read
    std::uint16_t pulse_us;
  };

  /// Its end of a line. Throws std::runtime_error naming what the system refuses.
  static std::unique_ptr<EmulatedSocket> open_line() { return emulated_bus("rekick", "can"); }

  std::vector<std::string> take(std::string_view bytes, std::int64_t now_ns) override;
  std::vector<std::string> tick(std::int64_t now_ns) override;
  std::int64_t next_ns() const override { return to_say_.empty() ? kNever_ns : 0; }

  /// Speaks by itself: resets, texts, error frames of the interface.
  void say(const can::Frame& frame) { to_say_.push_back(frame); }

  bool supply_on = true;
  /// Of the whole; in place of what the board assumes of its capacitor. None: it assumes.
  std::optional<double> measured_energy{};
  EmulatedFaults faults;

  const std::vector<Pulse>& pulses() const { return pulses_; }
  /// Kicks that came, those that were ignored among them.
  std::uint64_t kicks_told() const { return kicks_told_; }
  std::uint64_t voltages_told() const { return voltages_told_; }
  /// Questions for the state so far, and when the last was read.
  std::uint64_t looks() const { return looks_; }
  std::int64_t last_look_ns() const { return last_look_ns_; }
  double capacitor_v(std::int64_t now_ns) const;

 private:
  void obey(const can::Frame& frame, std::int64_t now_ns, std::vector<std::string>& said);
  void kick(std::uint16_t pulse_us, std::int64_t now_ns);
  void answer(const can::Frame& frame, std::vector<std::string>& said);
  double energy(std::int64_t now_ns) const;
  bool hits(int every) const { return every > 0 && answers_ % static_cast<std::uint64_t>(every) == 0; }

  std::vector<can::Frame> to_say_;
  std::vector<Pulse> pulses_;
  std::uint64_t kicks_told_ = 0;
  std::uint64_t voltages_told_ = 0;
  std::uint64_t looks_ = 0;
  std::uint64_t answers_ = 0;
  std::int64_t last_look_ns_ = 0;
  std::int64_t pulse_ends_ns_ = 0;
  std::uint16_t max_voltage_v_ = 0;
  double energy_ = 0.0;  // of the whole, at energy_ns_
  std::int64_t energy_ns_ = 0;
};

/// A ReKick board that is not there, behind a SOCK_SEQPACKET socket in place of a CAN bus.
using Emulator = hal::Emulator<EmulatedBoard>;

}  // namespace trivela::hal::rekick
