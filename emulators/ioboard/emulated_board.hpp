#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "emulators/line/emulator.hpp"
#include "hal/ioboard/frame.hpp"

namespace trivela::hal::ioboard {

/// What an emulated board is told to do wrong. A plain number counts down as it is done; `every` n: each n-th answer.
struct EmulatedFaults {
  bool silent = false;
  bool refuses = false;  ///< knows no command
  int lost = 0;          ///< answers that are not sent
  int garbled = 0;       ///< answers in whose place noise comes
  int wrong_sums = 0;
  int lost_every = 0;
  int garbled_every = 0;
  int wrong_sums_every = 0;
  bool floods = false;  ///< noise without end, between the answers
};

/// The behaviour of an ioBoard: a pulse under way ignores another, a lever that moves ignores another height, and both
/// are answered like those that are done. Source: Falcons-Robocup/code, peripherals/ioBoard/src/{main,Shoot_Pulse,
/// Shoot_Level}.c. The lever's time for a position is that of its default speed.
class EmulatedBoard final : public EmulatedDevice {
 public:
  static constexpr std::int64_t kLeverStep_ns = 1'200'000;

  struct Pulse {
    std::int64_t t_ns;   ///< when the last byte of the order was read
    std::uint8_t units;  ///< of kPulseUnit_us
  };

  /// Its end of a line. Throws std::runtime_error naming what the system refuses.
  static std::unique_ptr<EmulatedSocket> open_line() { return emulated_terminal("ioboard", "kicker"); }

  std::vector<std::string> take(std::string_view bytes, std::int64_t now_ns) override;
  std::int64_t next_ns() const override { return faults.floods ? next_noise_ns_ : kNever_ns; }
  std::vector<std::string> tick(std::int64_t now_ns) override;
  void hang_up() override { parser_ = {}; }

  bool in_play = true;
  bool software_on = true;
  EmulatedFaults faults;

  /// Pulses of the coil so far.
  const std::vector<Pulse>& pulses() const { return pulses_; }
  /// Orders to shoot that came, those that were ignored among them.
  std::uint64_t shots_told() const { return shots_told_; }
  /// Heights that came, those that were ignored among them.
  std::uint64_t heights_told() const { return heights_told_; }
  /// Questions for the switches so far, and when the last was read.
  std::uint64_t looks() const { return looks_; }
  std::int64_t last_look_ns() const { return last_look_ns_; }
  std::uint8_t lever() const { return lever_; }

 private:
  Frame answer(Frame question, std::int64_t now_ns);
  void shoot(std::uint8_t units, std::int64_t now_ns);
  void move_lever(std::uint8_t height, std::int64_t now_ns);
  std::string spoil(std::string answer);
  bool hit(int& left, int every) const;

  FrameParser parser_;
  std::vector<Pulse> pulses_;
  std::uint64_t looks_ = 0;
  std::int64_t last_look_ns_ = 0;
  std::uint64_t shots_told_ = 0;
  std::uint64_t heights_told_ = 0;
  std::uint64_t answers_ = 0;
  std::int64_t next_noise_ns_ = 0;
  std::uint8_t lever_ = 0;
  std::int64_t pulse_ends_ns_ = 0;
  std::int64_t lever_rests_ns_ = 0;
};

/// An ioBoard that is not there, on a pseudo-terminal.
using Emulator = hal::Emulator<EmulatedBoard>;

}  // namespace trivela::hal::ioboard
