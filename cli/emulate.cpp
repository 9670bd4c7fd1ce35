#include <fmt/core.h>
#include <poll.h>

#include <charconv>
#include <chrono>
#include <memory>

#include "cli/launch/signal_inbox.hpp"
#include "cli/output.hpp"
#include "cli/verbs.hpp"
#include "hal/ioboard/emulator.hpp"

namespace trivela::cli {
namespace {

using Clock = std::chrono::steady_clock;
using hal::EmulatedLine;

/// What an emulated board does wrong, and how its switches stand.
struct EmulateBoardFlags {
  std::vector<std::string> faults;
  bool disarmed = false;
};

/// The number of a fault "NAME=N"; none: it is another fault. Throws UsageError where it is no number above zero.
std::optional<int> number_of(const std::string& fault, const std::string& name) {
  if (!fault.starts_with(name + "=")) return std::nullopt;
  const char* const first = fault.data() + name.size() + 1;
  const char* const last = fault.data() + fault.size();
  int number = 0;
  const auto [end, error] = std::from_chars(first, last, number);
  if (error != std::errc{} || end != last || number <= 0)
    throw UsageError{fmt::format("--faults {}: expected a whole number above 0 after {}=", fault, name)};
  return number;
}

/// Pulls the cable for a second, every `every` seconds.
class LooseCable {
 public:
  explicit LooseCable(EmulatedLine& line, std::optional<int> every_s) : line_(line), every_s_(every_s) {}

  void move() {
    if (!every_s_ || Clock::now() < next_) return;
    pulled_ ? line_.plug() : line_.pull();
    pulled_ = !pulled_;
    next_ = Clock::now() + std::chrono::seconds(pulled_ ? 1 : *every_s_);
  }

 private:
  EmulatedLine& line_;
  std::optional<int> every_s_;
  bool pulled_ = false;
  Clock::time_point next_ = Clock::now() + std::chrono::seconds(every_s_.value_or(0));
};

/// Prints the address and then calls `look` ten times a second, until Ctrl-C.
template <class Look>
int run_until_stopped(SignalInbox& signals, const std::string& address, Look look) {
  say(address + "\n");
  std::fflush(stdout);
  pollfd inbox{signals.file_descriptor(), POLLIN, 0};
  while (!signals.stop_requested()) {
    look();
    std::fflush(stdout);
    poll(&inbox, 1, 100);
  }
  return kDone;
}

/// Sets the faults and gives how often the cable is pulled.
std::optional<int> take_faults(const std::vector<std::string>& faults, hal::ioboard::EmulatedFaults& out) {
  std::optional<int> unplugged_every_s;
  for (const std::string& fault : faults) {
    if (const auto every = number_of(fault, "lost")) {
      out.lost_every = *every;
    } else if (const auto garbled = number_of(fault, "garbled")) {
      out.garbled_every = *garbled;
    } else if (const auto wrong = number_of(fault, "wrong_sums")) {
      out.wrong_sums_every = *wrong;
    } else if (const auto seconds = number_of(fault, "unplug")) {
      unplugged_every_s = seconds;
    } else {
      throw UsageError{fmt::format("--faults {}: expected lost=N, garbled=N, wrong_sums=N or unplug=SECONDS", fault)};
    }
  }
  return unplugged_every_s;
}

int emulate_ioboard(const EmulateBoardFlags& flags) {
  hal::ioboard::EmulatedFaults faults;
  const auto unplugged_every_s = take_faults(flags.faults, faults);
  SignalInbox signals;  // before the emulator's thread, which must not take them
  hal::ioboard::Emulator emulator;
  emulator.with_board([&](hal::ioboard::EmulatedBoard& board) {
    board.in_play = !flags.disarmed;
    board.faults = faults;
  });
  LooseCable cable{emulator.line(), unplugged_every_s};
  std::size_t said = 0;
  return run_until_stopped(signals, emulator.address(), [&] {
    cable.move();
    emulator.with_board([&](const hal::ioboard::EmulatedBoard& board) {
      for (; said < board.pulses().size(); ++said)
        say(fmt::format("pulse of {:.3f} ms\n", board.pulses()[said].units * hal::ioboard::kPulseUnit_us / 1000.0));
    });
  });
}

void add_emulate_ioboard(CLI::App& verb, int& exit_code) {
  auto* device = verb.add_subcommand("ioboard", "The Falcons' ioBoard, on a pseudo-terminal");
  auto flags = std::make_shared<EmulateBoardFlags>();
  device
      ->add_option("--faults", flags->faults,
                   "lost=N, garbled=N, wrong_sums=N: each N-th answer; unplug=SECONDS: for a second, as often")
      ->delimiter(',');
  device->add_flag("--disarmed", flags->disarmed, "the in-play switch is open");
  device->callback([flags, &exit_code] { exit_code = emulate_ioboard(*flags); });
}

}  // namespace

void add_emulate(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("emulate", "Be a device that is not there");
  verb->footer("Prints the address to connect to, then what it is told to do, until Ctrl-C.");
  verb->require_subcommand(1);
  add_emulate_ioboard(*verb, exit_code);
}

}  // namespace trivela::cli
