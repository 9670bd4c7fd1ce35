#include <fmt/core.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>

#include "calibration/scanner_session.hpp"
#include "cli/launch/progress_bar.hpp"
#include "cli/launch/signals.hpp"
#include "cli/options/output.hpp"
#include "cli/scan/verb_parts.hpp"
#include "cli/verbs.hpp"
#include "hal/open.hpp"
#include "kicking/geometry/time.hpp"

namespace trivela::cli {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kLook{200};  // between two looks at the signals and the terminal

}  // namespace

int record_scans(const std::filesystem::path& out, const std::string& device, const MountFlags& mount,
                 std::optional<double> seconds, std::optional<double> power) {
  calibration::refuse_existing(out);
  SignalInbox signals;
  ProgressBar line;
  const auto finder = hal::open_range_finder(device);
  if (isatty(STDERR_FILENO) == 0) fmt::print(stderr, "waiting for {}; Ctrl-C ends\n", device);
  while (!finder->connected(kLook)) {
    line.show(0.0, 0.0, "waiting for " + device + ": " + finder->status());
    if (signals.stop_requested()) throw std::runtime_error{fmt::format("nothing was recorded: {}", finder->status())};
  }
  const log::ScanSession session = calibration::scanner_session(*finder, mount.mount(), device);
  log::ScanWriter writer(out, session);
  if (power) writer.set_point({.t_ns = session.started_t_ns, .power = *power});
  const Clock::time_point started = Clock::now();
  std::size_t scans = 0;
  std::size_t refused = 0;
  std::optional<std::int64_t> first_t_ns;
  while (!signals.stop_requested()) {
    const std::chrono::duration<double> passed = Clock::now() - started;
    if (seconds && passed.count() >= *seconds) break;
    if (const auto scan = finder->read(kLook)) {
      // By the scanner's clock: scans that waited for the file to be made are of this time, too.
      if (!first_t_ns) first_t_ns = scan->t_ns;
      if (seconds && kicking::seconds(*first_t_ns, scan->t_ns) >= *seconds) break;
      scan->range_mm.size() == session.geometry.beams&& writer.push(*scan) ? ++scans : ++refused;
    }
    line.show(0.0, 0.0,
              fmt::format("{:.0f} s, {} scans, {} lost; {}", passed.count(), scans, finder->counters().lost_scans,
                          finder->status()));
  }
  writer.finalise();
  const hal::LinkCounters counters = finder->counters();
  say(fmt::format("{}: {} scans of {} {}\n", out.string(), scans, session.identity.vendor, session.identity.product));
  if (session.simulated) fmt::print("{}\n", kSyntheticNotice);
  if (counters.error_ranges > 0) fmt::print("{} beams had an error code in place of a range\n", counters.error_ranges);
  if (counters.lost_scans + refused == 0) return kDone;
  fmt::print(stderr,
             "trivela: {} scans were lost on the line ({} torn lines, {} wrong sums, opened again {} times) and {} "
             "could not be recorded\n",
             counters.lost_scans, counters.torn_lines, counters.wrong_sums, counters.reconnects, refused);
  return kDoneWithLoss;
}

}  // namespace trivela::cli
