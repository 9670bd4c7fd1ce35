#include "tests/faults/drivers_words.hpp"

#include <algorithm>
#include <iterator>
#include <optional>

namespace trivela::faults {
namespace {

using Nanoseconds = std::chrono::nanoseconds;

/// What lies between the wire's copy of a word and the driver's.
struct Spread {
  std::int64_t least_ns = 0, most_ns = 0;
};

/// None: the fault delays no word on its way to the driver. Where all that the referee says is late, the wire's copy
/// is, too.
std::optional<Spread> spread_of(const Fault& fault) {
  const std::size_t driver = node_index("kicker_driver"), referee = node_index("referee");
  if (fault.kind != FaultKind::kDelay) return std::nullopt;
  const std::int64_t delay_ns = Nanoseconds{fault.way.delay}.count(), jitter_ns = Nanoseconds{fault.way.jitter}.count();
  if (!fault.other && fault.node == referee) return Spread{-jitter_ns, jitter_ns};
  const bool own_cable = !fault.other && fault.node == driver;
  const bool link =
      (fault.node == driver && fault.other == referee) || (fault.node == referee && fault.other == driver);
  if (!own_cable && !link) return std::nullopt;
  return Spread{delay_ns, delay_ns + jitter_ns};
}

/// A reader hands on what was said first first: no word to stop comes after a later one to play.
void say_in_order(std::vector<CommandSeen>& received, const CommandSeen& next) {
  while (next.playing && !received.empty() && received.back().arrival_ns > next.arrival_ns) received.pop_back();
}

/// In the order in which they were said, that of the wire.
std::vector<CommandSeen> heard_late(const Testimony& wire, const Trial& trial, std::int64_t to_ns,
                                    const Spread& spread) {
  std::vector<CommandSeen> received;
  for (const CommandSeen& word : wire.words) {
    if (word.arrival_ns < trial.began_ns || word.arrival_ns > to_ns) continue;
    const bool late = word.arrival_ns <= trial.ended_ns;
    const std::int64_t arrival_ns = word.arrival_ns + (!word.playing ? spread.most_ns
                                                       : late        ? spread.least_ns
                                                                     : std::min<std::int64_t>(0, spread.least_ns));
    const CommandSeen seen{arrival_ns, word.playing};
    say_in_order(received, seen);
    received.push_back(seen);
  }
  return received;
}

}  // namespace

bool garbles_driver(const Fault& fault) {
  const std::size_t driver = node_index("kicker_driver");
  return fault.kind == FaultKind::kGarble && (fault.node == driver || !fault.other || fault.other == driver);
}

Testimony with_drivers_words(Testimony device, const Testimony& wire, const std::vector<Trial>& trials) {
  for (const Trial& trial : trials) {
    if (const auto spread = spread_of(trial.fault)) {
      // What is on its way when the fault ends.
      const std::int64_t to_ns = trial.ended_ns + Nanoseconds{trial.fault.way.delay + trial.fault.way.jitter}.count();
      std::erase_if(device.words, [&](const CommandSeen& word) {
        return word.arrival_ns >= trial.began_ns && word.arrival_ns <= to_ns;
      });
      std::vector<CommandSeen> received = heard_late(wire, trial, to_ns, *spread);
      for (const CommandSeen& word : device.words)
        if (word.arrival_ns > to_ns) say_in_order(received, word);
      std::ranges::copy(received, std::back_inserter(device.words));
    } else if (garbles_driver(trial.fault)) {
      std::ranges::copy_if(wire.words, std::back_inserter(device.words), [&](const CommandSeen& word) {
        return word.arrival_ns >= trial.began_ns && word.arrival_ns <= trial.whole_ns;
      });
    }
  }
  std::ranges::stable_sort(device.words, {}, &CommandSeen::arrival_ns);
  return device;
}

}  // namespace trivela::faults
