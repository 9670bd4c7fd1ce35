#include "tests/faults/troubled_board.hpp"

#include <array>
#include <cmath>

#include "emulators/ioboard/emulated_board.hpp"
#include "emulators/rekick/emulated_board.hpp"
#include "hal/can/can_line.hpp"

namespace trivela::faults {
namespace {

/// What both have: a line that can be cut and held back, and pulses.
template <class Board>
class BoardOnALine : public TroubledBoard {
 public:
  void begin(Trouble what) override {
    what_ = what;
    if (what == Trouble::kUnplug) emulator_.line().pull();
    if (what == Trouble::kHold) emulator_.line().hold(true);
    emulator_.with_board([&](Board& board) { spoil(board, what); });
  }
  void end() override {
    if (what_ == Trouble::kUnplug) emulator_.line().plug();
    if (what_ == Trouble::kHold) emulator_.line().hold(false);
    what_ = Trouble::kRestart;
    emulator_.with_board([](Board& board) { board.faults = {}; });
  }
  bool wait_for_pulse(std::size_t before, std::chrono::nanoseconds timeout) override {
    return emulator_.wait(timeout, [before](const Board& board) { return board.pulses().size() > before; });
  }

 protected:
  virtual void spoil(Board& board, Trouble what) = 0;

  hal::Emulator<Board> emulator_;
  Trouble what_ = Trouble::kRestart;
};

class IoBoardOnALine final : public BoardOnALine<hal::ioboard::EmulatedBoard> {
 public:
  config::KickerDevice host() const override {
    return config::IoBoardDevice{.port = emulator_.address(), .charge_time_s = 0.2};
  }
  std::vector<Trouble> troubles() const override {
    return {Trouble::kUnplug,    Trouble::kHold,  Trouble::kSilent, Trouble::kLost, Trouble::kGarbled,
            Trouble::kWrongSums, Trouble::kFlood, Trouble::kKill,   Trouble::kStop, Trouble::kRestart};
  }
  void stir() override {}
  std::vector<BoardPulse> pulses() override {
    std::vector<BoardPulse> found;
    emulator_.with_board([&](const hal::ioboard::EmulatedBoard& board) {
      for (const auto& pulse : board.pulses()) found.push_back({pulse.t_ns, pulse.units});
    });
    return found;
  }

 private:
  void spoil(hal::ioboard::EmulatedBoard& board, Trouble what) override {
    board.faults.silent = what == Trouble::kSilent;
    board.faults.lost_every = what == Trouble::kLost ? 2 : 0;
    board.faults.garbled_every = what == Trouble::kGarbled ? 2 : 0;
    board.faults.wrong_sums_every = what == Trouble::kWrongSums ? 2 : 0;
    board.faults.floods = what == Trouble::kFlood;
  }
};

/// A garbled frame is one that the interface reports, or that is shorter than it was sent: what the bus's own checksum
/// does not find is not made.
class ReKickOnABus final : public BoardOnALine<hal::rekick::EmulatedBoard> {
 public:
  ReKickOnABus() {
    emulator_.with_board([](hal::rekick::EmulatedBoard& board) { board.measured_energy = 1.0; });
  }
  config::KickerDevice host() const override { return host_; }
  std::vector<Trouble> troubles() const override {
    return {Trouble::kUnplug,    Trouble::kHold,  Trouble::kSilent, Trouble::kLost, Trouble::kGarbled,
            Trouble::kErrorFlag, Trouble::kFlood, Trouble::kKill,   Trouble::kStop, Trouble::kRestart};
  }
  void stir() override {
    namespace can = hal::can;
    constexpr int kFrames = 200;  // of what a bus of 1 Mbit/s carries in 50 ms
    constexpr can::Frame kNoise{.id = 0x8, .extended = false, .error = true, .size = 8, .data = {}};
    emulator_.with_board([&](hal::rekick::EmulatedBoard& board) {
      for (int i = 0; what_ == Trouble::kFlood && i < kFrames; ++i)
        board.say(can::extended_frame(0x40A000, {0xF2, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}));
      if (what_ != Trouble::kGarbled) return;
      board.say(kNoise);
      board.say(hal::rekick::from_board({static_cast<std::uint8_t>(hal::rekick::Command::kState), 0xFF, 0xFF}));
      board.say(hal::rekick::from_board({static_cast<std::uint8_t>(hal::rekick::Command::kWarning), 0x07, 0xFF}));
    });
  }
  std::vector<BoardPulse> pulses() override {
    std::vector<BoardPulse> found;
    emulator_.with_board([&](const hal::rekick::EmulatedBoard& board) {
      for (const auto& pulse : board.pulses())
        found.push_back({pulse.t_ns, static_cast<int>(std::lround(pulse.pulse_us / host_.pulse_us_per_power))});
    });
    return found;
  }

 private:
  void spoil(hal::rekick::EmulatedBoard& board, Trouble what) override {
    board.faults.silent = what == Trouble::kSilent;
    board.faults.lost_every = what == Trouble::kLost ? 2 : 0;
    board.faults.error = what == Trouble::kErrorFlag;
  }

  config::ReKickDevice host_{.port = emulator_.address()};
};

}  // namespace

std::string_view name(Trouble what) {
  constexpr std::array kNames{"unplug", "hold",  "silent", "lost", "garbled", "wrong sums",
                              "error",  "flood", "kill",   "stop", "restart"};
  return kNames.at(static_cast<std::size_t>(what));
}

std::unique_ptr<TroubledBoard> troubled_ioboard() { return std::make_unique<IoBoardOnALine>(); }
std::unique_ptr<TroubledBoard> troubled_rekick() { return std::make_unique<ReKickOnABus>(); }

}  // namespace trivela::faults
