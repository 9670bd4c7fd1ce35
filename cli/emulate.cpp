#include <fmt/core.h>
#include <poll.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/launch/signal_inbox.hpp"
#include "cli/output.hpp"
#include "cli/verbs.hpp"
#include "hal/ioboard/emulator.hpp"
#include "hal/rekick/emulator.hpp"

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

/// Pulls the cable for a second, every `every_s` seconds; 0: never.
class LooseCable {
 public:
  LooseCable(EmulatedLine& line, int every_s) : line_(line), every_s_(every_s) {}

  void move() {
    if (every_s_ == 0 || Clock::now() < next_) return;
    pulled_ ? line_.plug() : line_.pull();
    pulled_ = !pulled_;
    next_ = Clock::now() + std::chrono::seconds(pulled_ ? 1 : every_s_);
  }

 private:
  EmulatedLine& line_;
  int every_s_;
  bool pulled_ = false;
  Clock::time_point next_ = Clock::now() + std::chrono::seconds(every_s_);
};

/// Prints the address and then each pulse of the coil, until Ctrl-C. `length_us` is that of a pulse.
template <class Emulator, class Length>
int run_until_stopped(SignalInbox& signals, Emulator& emulator, int unplug_s, Length length_us) {
  say(emulator.address() + "\n");
  LooseCable cable{emulator.line(), unplug_s};
  pollfd inbox{signals.file_descriptor(), POLLIN, 0};
  for (std::size_t said = 0; !signals.stop_requested(); poll(&inbox, 1, 100)) {
    cable.move();
    emulator.with_board([&](const auto& board) {
      for (; said < board.pulses().size(); ++said)
        say(fmt::format("pulse of {:.3f} ms\n", length_us(board.pulses()[said]) / 1000.0));
    });
    std::fflush(stdout);
  }
  return kDone;
}

/// A fault's name and the number that it sets.
using FaultNumbers = std::vector<std::pair<std::string, int*>>;

/// Sets the numbers of the faults that are named. Throws UsageError for one that is none.
void take_faults(const std::vector<std::string>& faults, const FaultNumbers& numbers) {
  for (const std::string& fault : faults) {
    const auto set = [&](const auto& number) {
      const auto value = number_of(fault, number.first);
      if (value) *number.second = *value;
      return value.has_value();
    };
    if (std::ranges::any_of(numbers, set)) continue;
    std::string names;
    for (const auto& [name, number] : numbers) names += (names.empty() ? "" : ", ") + name + "=N";
    throw UsageError{fmt::format("--faults {}: expected one of: {}", fault, names)};
  }
}

int emulate_ioboard(const EmulateBoardFlags& flags) {
  hal::ioboard::EmulatedFaults faults;
  int unplug_s = 0;
  take_faults(flags.faults, {{"lost", &faults.lost_every},
                             {"garbled", &faults.garbled_every},
                             {"wrong_sums", &faults.wrong_sums_every},
                             {"unplug", &unplug_s}});
  SignalInbox signals;  // before the emulator's thread, which must not take them
  hal::ioboard::Emulator emulator;
  emulator.with_board([&](hal::ioboard::EmulatedBoard& board) {
    board.in_play = !flags.disarmed;
    board.faults = faults;
  });
  return run_until_stopped(signals, emulator, unplug_s, [](const hal::ioboard::EmulatedBoard::Pulse& pulse) {
    return pulse.units * hal::ioboard::kPulseUnit_us;
  });
}

int emulate_rekick(const EmulateBoardFlags& flags) {
  hal::rekick::EmulatedFaults faults;
  int unplug_s = 0;
  take_faults(flags.faults,
              {{"lost", &faults.lost_every}, {"strangers", &faults.strangers_every}, {"unplug", &unplug_s}});
  SignalInbox signals;
  hal::rekick::Emulator emulator;
  emulator.with_board([&](hal::rekick::EmulatedBoard& board) {
    board.supply_on = !flags.disarmed;
    board.faults = faults;
  });
  return run_until_stopped(signals, emulator, unplug_s, [](const hal::rekick::EmulatedBoard::Pulse& pulse) {
    return static_cast<double>(pulse.pulse_us);
  });
}

void add_board(CLI::App& verb, int& exit_code, const std::string& name, const std::string& help,
               const std::string& faults, int (*emulate)(const EmulateBoardFlags&)) {
  auto* device = verb.add_subcommand(name, help);
  auto flags = std::make_shared<EmulateBoardFlags>();
  device->add_option("--faults", flags->faults, faults + "; unplug=N: for a second, every N seconds")->delimiter(',');
  device->add_flag("--disarmed", flags->disarmed, "a switch is open: it says that it may not be fired");
  device->callback([flags, emulate, &exit_code] { exit_code = emulate(*flags); });
}

}  // namespace

void add_emulate(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("emulate", "Be a device that is not there");
  verb->footer("Prints the address to connect to, then what it is told to do, until Ctrl-C.");
  verb->require_subcommand(1);
  add_board(*verb, exit_code, "ioboard", "The Falcons' ioBoard, on a pseudo-terminal",
            "lost=N, garbled=N, wrong_sums=N: so is each N-th answer", emulate_ioboard);
  add_board(*verb, exit_code, "rekick", "A ReKick board, behind a SOCK_SEQPACKET socket in place of a CAN bus",
            "lost=N: so is each N-th answer; strangers=N: before it another device speaks", emulate_rekick);
}

}  // namespace trivela::cli
