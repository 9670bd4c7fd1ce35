#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/emulate/devices.hpp"
#include "cli/launch/signals.hpp"
#include "cli/options/output.hpp"
#include "emulators/cia402/emulated_wheels.hpp"
#include "emulators/ioboard/emulated_board.hpp"
#include "emulators/mti/emulated_mti.hpp"
#include "emulators/rekick/emulated_board.hpp"

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

/// Something that is wrong for a second, every `every_s` seconds; 0: never.
class IntermittentFault {
 public:
  explicit IntermittentFault(int every_s) : every_s_(every_s) {}

  /// True: it begins, false: it ends, now.
  std::optional<bool> changes() {
    if (every_s_ == 0 || Clock::now() < next_) return std::nullopt;
    on_ = !on_;
    next_ = Clock::now() + std::chrono::seconds(on_ ? 1 : every_s_);
    return on_;
  }

 private:
  int every_s_;
  bool on_ = false;
  Clock::time_point next_ = Clock::now() + std::chrono::seconds(every_s_);
};

/// A cable that is out for such spells.
class CableFault {
 public:
  CableFault(EmulatedLine& line, int every_s) : line_(line), spell_(every_s) {}

  void move() {
    if (const auto out = spell_.changes()) *out ? line_.pull() : line_.plug();
  }

 private:
  EmulatedLine& line_;
  IntermittentFault spell_;
};

/// Prints the address, then lets `look` see the device ten times a second, until Ctrl-C.
template <class Emulator, class Look>
int watch_until_stopped(SignalInbox& signals, Emulator& emulator, int unplug_s, Look look) {
  say(emulator.address() + "\n");
  CableFault cable{emulator.line(), unplug_s};
  do {
    cable.move();
    emulator.with_board(std::ref(look));  // a copy would forget what it has said
    std::fflush(stdout);
  } while (!signals.stop_requested_within(100));
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

/// Emulates a kicker's board and says each pulse of its coil, of length_us(pulse). `numbers`: what each fault sets;
/// "unplug" is added here. `armed`: the member that is its switch.
template <class Emulator, class Board>
int emulate_board(const EmulateBoardFlags& flags, const auto& faults, FaultNumbers numbers, bool Board::*armed,
                  const auto& length_us) {
  int unplug_s = 0;
  numbers.emplace_back("unplug", &unplug_s);
  take_faults(flags.faults, numbers);
  SignalInbox signals;  // before the emulator's thread, which must not take them
  Emulator emulator;
  emulator.with_board([&](Board& board) {
    board.*armed = !flags.disarmed;
    board.faults = faults;
  });
  return watch_until_stopped(signals, emulator, unplug_s, [&, said = std::size_t{0}](const Board& board) mutable {
    for (; said < board.pulses().size(); ++said)
      say(fmt::format("pulse of {:.3f} ms\n", length_us(board.pulses()[said]) / 1000.0));
  });
}

int emulate_ioboard(const EmulateBoardFlags& flags) {
  hal::ioboard::EmulatedFaults faults;
  return emulate_board<hal::ioboard::Emulator>(
      flags, faults,
      {{"lost", &faults.lost_every}, {"garbled", &faults.garbled_every}, {"wrong_sums", &faults.wrong_sums_every}},
      &hal::ioboard::EmulatedBoard::in_play,
      [](const auto& pulse) { return pulse.units * hal::ioboard::kPulseUnit_us; });
}

int emulate_rekick(const EmulateBoardFlags& flags) {
  hal::rekick::EmulatedFaults faults;
  return emulate_board<hal::rekick::Emulator>(
      flags, faults, {{"lost", &faults.lost_every}, {"foreign", &faults.foreign_every}},
      &hal::rekick::EmulatedBoard::supply_on, [](const auto& pulse) { return static_cast<double>(pulse.pulse_us); });
}

/// What an emulated base does wrong: spells of so many seconds, 0: none; a drive's node, 0: none.
struct DriveFaults {
  int bus_off_s = 0;
  int overcurrent_s = 0;
  int silent_s = 0;
  int unplug_s = 0;
  int refuses_heartbeat = 0;
};

/// Tells the drives what goes wrong now, and says what they do.
class DrivesShow {
 public:
  explicit DrivesShow(const DriveFaults& faults)
      : bus_off_(faults.bus_off_s), overcurrent_(faults.overcurrent_s), silent_(faults.silent_s) {}

  void look(hal::cia402::EmulatedDrives& drives) {
    constexpr std::uint16_t kOvercurrent = 0x2310;
    const std::int64_t now_ns = std::chrono::nanoseconds(Clock::now().time_since_epoch()).count();
    if (bus_off_.changes() == true) drives.say(hal::can::bus_off_frame());
    if (overcurrent_.changes() == true) drives.fail(1, kOvercurrent, now_ns);
    if (const auto silent = silent_.changes()) drives.drive(1).faults.silent = *silent;
    states_.resize(drives.drives().size(), hal::cia402::DriveState::kSwitchOnDisabled);
    bool turns = false;
    for (std::size_t i = 0; i < states_.size(); ++i) {
      const auto& drive = drives.drives()[i];
      turns = turns || std::abs(drive.rpm(now_ns)) >= 1.0;
      if (std::exchange(states_[i], drive.state()) == drive.state()) continue;
      say(fmt::format("drive {}: {}\n", drive.node(), hal::cia402::name(drive.state())));
    }
    if (std::exchange(turns_, turns) != turns) say(turns ? "the wheels turn\n" : "the wheels stand\n");
  }

 private:
  IntermittentFault bus_off_, overcurrent_, silent_;
  std::vector<hal::cia402::DriveState> states_;
  bool turns_ = false;
};

struct DrivesFlags {
  std::vector<std::string> faults;
  int drives = 3;
};

int emulate_cia402(const DrivesFlags& flags) {
  DriveFaults faults;
  take_faults(flags.faults, {{"bus_off", &faults.bus_off_s},
                             {"overcurrent", &faults.overcurrent_s},
                             {"silent", &faults.silent_s},
                             {"refuses_1016", &faults.refuses_heartbeat},
                             {"unplug", &faults.unplug_s}});
  if (faults.refuses_heartbeat > flags.drives)
    throw UsageError{
        fmt::format("--faults refuses_1016={}: there are {} drives", faults.refuses_heartbeat, flags.drives)};
  SignalInbox signals;
  hal::cia402::Emulator emulator{static_cast<std::uint8_t>(flags.drives)};
  emulator.with_board([&](hal::cia402::EmulatedDrives& drives) {
    if (const int node = faults.refuses_heartbeat; node > 0)
      drives.drive(static_cast<std::uint8_t>(node)).faults.refuses_heartbeat = true;
  });
  DrivesShow show{faults};
  return watch_until_stopped(signals, emulator, faults.unplug_s,
                             [&](hal::cia402::EmulatedDrives& drives) { show.look(drives); });
}

struct MtiFlags {
  std::vector<std::string> faults;
  double rate_radps = 0.0;
};

int emulate_mti(const MtiFlags& flags) {
  hal::mti::EmulatedFaults faults;
  int unplug_s = 0;
  take_faults(flags.faults,
              {{"garbled", &faults.garbled_every}, {"wrong_sums", &faults.wrong_sums_every}, {"unplug", &unplug_s}});
  SignalInbox signals;
  hal::mti::Emulator emulator;
  emulator.with_board([&](hal::mti::EmulatedMti& mti) {
    mti.faults = faults;
    mti.rate_radps = flags.rate_radps;
  });
  return watch_until_stopped(signals, emulator, unplug_s, [](const hal::mti::EmulatedMti&) {});
}

void add_board(CLI::App& app, int& exit_code, const std::string& name, const std::string& help,
               const std::string& faults, int (*emulate)(const EmulateBoardFlags&)) {
  const auto [device, flags] = add_verb(app, exit_code, name, help, emulate);
  device->add_option("--faults", flags->faults, faults + "; unplug=N: for a second, every N seconds")->delimiter(',');
  device->add_flag("--disarmed", flags->disarmed, "a switch is open: it says that it may not be fired");
}

}  // namespace

void add_ioboard(CLI::App& app, int& exit_code) {
  add_board(app, exit_code, "ioboard", "The Falcons' ioBoard, on a pseudo-terminal",
            "lost=N, garbled=N, wrong_sums=N: so is each N-th answer", emulate_ioboard);
}

void add_rekick(CLI::App& app, int& exit_code) {
  add_board(app, exit_code, "rekick", "A ReKick board, behind a SOCK_SEQPACKET socket in place of a CAN bus",
            "lost=N: so is each N-th answer; foreign=N: before it another device sends a frame", emulate_rekick);
}

void add_cia402(CLI::App& app, int& exit_code) {
  const auto [device, flags] =
      add_verb(app, exit_code, "cia402", "Drives of a base, behind a SOCK_SEQPACKET socket in place of a CAN bus",
               emulate_cia402);
  add_default(*device, "--drives", flags->drives, "how many, nodes 1 and on", CLI::Range(1, 4));
  device
      ->add_option("--faults", flags->faults,
                   "bus_off=N, overcurrent=N, silent=N (drive 1), unplug=N: for a second, every N seconds; "
                   "refuses_1016=N: drive N has no such object")
      ->delimiter(',');
}

void add_mti(CLI::App& app, int& exit_code) {
  const auto [device, flags] = add_verb(app, exit_code, "mti", "An Xsens MTi, on a pseudo-terminal", emulate_mti);
  device->add_option("--rate-radps", flags->rate_radps, "that it says, about its z axis")
      ->check(CLI::Range(-50.0, 50.0));
  device
      ->add_option("--faults", flags->faults,
                   "garbled=N, wrong_sums=N: so is each N-th message; unplug=N: for a second, every N seconds")
      ->delimiter(',');
}

}  // namespace trivela::cli
