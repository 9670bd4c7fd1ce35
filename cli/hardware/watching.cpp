#include "cli/hardware/tasks.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <set>

#include "cli/options/output.hpp"
#include "cli/verbs.hpp"

namespace trivela::cli {
namespace {

using WatchClock = std::chrono::steady_clock;

constexpr std::chrono::seconds kListingTimeout{3};
constexpr std::chrono::milliseconds kPollInterval{10};  // between two looks at the devices
constexpr std::chrono::milliseconds kRedraw{200};       // on a terminal
constexpr std::chrono::seconds kBetweenLines{1};        // in a pipe

bool silent(DeviceProbe& fixture) { return fixture.wanted() && !fixture.found(); }

/// Who has answered, and who did not at a later look.
struct Received {
  std::set<const DeviceProbe*> once, lapsed;

  void note(DeviceProbe& fixture) {
    if (!silent(fixture))
      once.insert(&fixture);
    else if (once.contains(&fixture))
      lapsed.insert(&fixture);
  }
};

/// Looks at every device until `end`. False: somebody asked to stop.
bool look_until(DeviceProbes& probes, WatchClock::time_point end, SignalInbox& signals, Received& received) {
  do {
    for (const auto& fixture : probes) {
      fixture->look();
      received.note(*fixture);
    }
    if (signals.stop_requested_within(static_cast<int>(kPollInterval.count()))) return false;
  } while (WatchClock::now() < end);
  return true;
}

bool all_found(const DeviceProbes& probes) {
  return std::ranges::none_of(probes, [](const auto& fixture) { return silent(*fixture); });
}

std::string line_of(const DeviceProbe& fixture, const std::string& values) {
  return fmt::format("{}: {}", fixture.name(), values);
}

/// Draws over what it drew before.
class LiveTable {
 public:
  void draw(const DeviceProbes& probes) {
    if (drawn_ > 0) fmt::print("\x1b[{}A", drawn_);
    drawn_ = 0;
    for (const auto& fixture : probes) {
      if (!fixture->wanted()) continue;
      fmt::print("\r\x1b[K");
      say(cut_to("  " + line_of(*fixture, fixture->values()), columns_of(STDOUT_FILENO)) + "\n");
      ++drawn_;
    }
    std::fflush(stdout);
  }

 private:
  int drawn_ = 0;
};

void say_line(const DeviceProbes& probes) {
  std::string line;
  for (const auto& fixture : probes) {
    if (fixture->wanted()) line += (line.empty() ? "" : " | ") + line_of(*fixture, fixture->values());
  }
  say(line + "\n");
  std::fflush(stdout);
}

}  // namespace

bool all_answer(const DeviceProbes& probes) {
  return all_found(probes) && std::ranges::all_of(probes, [](const auto& fixture) { return fixture->opened(); });
}

std::string listing(const DeviceProbes& probes) {
  std::string rows;
  for (const auto& fixture : probes) {
    const std::string says = fixture->says();
    rows += fmt::format("  {:<14}{:<28} {}{}\n", fixture->name(), fixture->device(),
                        !fixture->wanted()   ? "not used"
                        : !fixture->opened() ? "not opened"
                        : fixture->found()   ? "there"
                                             : "NOT THERE",
                        says.empty() ? "" : ": " + says);
  }
  return rows;
}

int watch(DeviceProbes& probes, std::optional<double> seconds, SignalInbox& signals) {
  const auto timeout_at = WatchClock::now() + kListingTimeout;
  bool goes_on = true;
  Received received;
  while (goes_on && !all_found(probes) && WatchClock::now() < timeout_at)
    goes_on = look_until(probes, WatchClock::now(), signals, received);
  if (goes_on) goes_on = look_until(probes, WatchClock::now() + kRedraw, signals, received);
  say(listing(probes));
  std::fflush(stdout);
  const bool terminal = can_be_drawn_over(STDOUT_FILENO);
  const auto step = terminal ? WatchClock::duration{kRedraw} : WatchClock::duration{kBetweenLines};
  const double lasts_s = std::max(seconds.value_or(1.0), terminal ? 0.0 : 1.0);
  LiveTable board;
  const auto began = WatchClock::now();
  for (int i = 1; goes_on; ++i) {
    if (!(terminal && !seconds) && std::chrono::duration<double>(step).count() * i > lasts_s) break;
    goes_on = look_until(probes, began + i * step, signals, received);
    if (!goes_on) break;
    terminal ? board.draw(probes) : say_line(probes);
  }
  for (const auto& fixture : probes) {
    if (received.lapsed.contains(fixture.get()) && !silent(*fixture))
      warn(fmt::format("{} did not answer all the time: is its cable loose?", fixture->name()));
  }
  return received.lapsed.empty() && all_answer(probes) ? kDone : kFailed;
}

}  // namespace trivela::cli
