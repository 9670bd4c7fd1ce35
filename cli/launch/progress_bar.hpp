#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>
#include <string>

#include "cli/launch/signals.hpp"
#include "cli/launch/terminal.hpp"

namespace trivela::cli {

/// Seconds as a person reads them: "42 s", "7 min", "3.4 h".
inline std::string time_text(double seconds) {
  if (seconds < 120.0) return fmt::format("{:.0f} s", seconds);
  return seconds < 7200.0 ? fmt::format("{:.0f} min", seconds / 60.0) : fmt::format("{:.1f} h", seconds / 3600.0);
}

/// One line of progress: share, time left and rate of what was done in `elapsed_s`. `done` of `total`: in `unit`, which
/// is empty where nobody counts in it; of a `total` of 0 nobody knows how much there is, and there is no time left. The
/// bar takes what the `columns` leave, 40 at most; the line is no wider than they are.
inline std::string progress_line(double done, double total, double elapsed_s, const std::string& unit,
                                 const std::string& what, std::size_t columns = 200) {
  constexpr std::size_t kWidest = 40, kNarrowest = 8;  // of the bar
  const double share = total > 0.0 ? std::clamp(done / total, 0.0, 1.0) : 0.0;
  std::string line;
  if (total > 0.0) {
    const double left_s = share > 0.0 ? elapsed_s * (1.0 - share) / share : 0.0;
    line = fmt::format("{:3.0f} %  {}  ", 100.0 * share, share > 0.0 ? time_text(left_s) + " left" : "begins");
  }
  if (!unit.empty()) {
    if (total <= 0.0) line += fmt::format("{:.0f} {}  ", done, unit);
    const double rate = elapsed_s > 0.0 ? done / elapsed_s : 0.0;
    line += rate >= 10.0 || rate == 0.0 ? fmt::format("{:.0f} {}/s  ", rate, unit)
                                        : fmt::format("{:.2g} {}/s  ", rate, unit);
  }
  line += what;
  const std::size_t beside = line.size() + 6;  // blanks and brackets
  if (total > 0.0 && columns >= beside + kNarrowest) {
    const std::size_t width = std::min(kWidest, columns - beside);
    line = fmt::format("[{:<{}}] {}", std::string(static_cast<std::size_t>(static_cast<double>(width) * share), '#'),
                       width, line);
  }
  return cut_to("  " + line, columns);
}

/// progress_line() on standard error, drawn over ten times a second at most. Silent unless that is a terminal that can
/// be drawn over.
class ProgressBar {
 public:
  ~ProgressBar() { end(); }
  ProgressBar() = default;
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Somebody sees it: what is shown may be worth some work.
  bool is_seen() const { return terminal_; }

  /// `done` of `total` since the first call; `what` stands behind it.
  void show(double done, double total, const std::string& unit, const std::string& what) {
    if (!terminal_) return;
    const auto now = std::chrono::steady_clock::now();
    if (!started_) started_ = now;
    const bool over = total > 0.0 && done >= total;
    if (drawn_ && !over && now - *drawn_ < std::chrono::milliseconds{100}) return;
    const double elapsed_s = std::chrono::duration<double>{now - *started_}.count();
    const std::size_t columns = columns_of(STDERR_FILENO) - 1;  // in the last one some terminals begin a line
    fmt::print(stderr, "\r{}\x1b[K", progress_line(done, total, elapsed_s, unit, what, columns));
    std::fflush(stderr);
    drawn_ = now;
  }

  /// The same where `what` says all that can be said.
  void show(double done, double total, const std::string& what) { show(done, total, "", what); }

  /// Time counts from now, on the same line.
  void restart() { started_.reset(); }

  /// The line stays as it is; the next one begins again.
  void end() {
    if (drawn_) std::fputs("\n", stderr);  // does not throw where the terminal is gone
    drawn_.reset();
    started_.reset();
  }

 private:
  using Instant = std::chrono::steady_clock::time_point;
  bool terminal_ = can_be_drawn_over(STDERR_FILENO);
  std::optional<Instant> started_;
  std::optional<Instant> drawn_;
};

/// Progress of a file that is being written. Until the first call Ctrl-C ends the program, since nothing is there yet;
/// from then on the call says whether to go on.
class StoppableBar {
 public:
  /// ProgressBar::show(). False: somebody asked to stop.
  bool show(double done, double total, const std::string& unit, const std::string& what) {
    if (!signals_) signals_.emplace();
    bar_.show(done, total, unit, what);
    stopped_ = stopped_ || signals_->stop_requested();
    return !stopped_;
  }

 private:
  std::optional<SignalInbox> signals_;
  ProgressBar bar_;
  bool stopped_ = false;
};

}  // namespace trivela::cli
