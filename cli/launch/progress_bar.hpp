#pragma once

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>

namespace trivela::cli {

/// One line on standard error that is drawn over: done, total, time left. Silent unless that is a terminal.
class ProgressBar {
 public:
  ~ProgressBar() {
    if (drawn_) std::fputs("\n", stderr);  // does not throw where the terminal is gone
  }

  /// Somebody sees it: what is shown may be worth some work.
  bool is_seen() const { return terminal_; }

  /// `done` of `total` in whatever unit; `what` stands behind the bar.
  void show(double done, double total, const std::string& what) {
    if (!terminal_ || total <= 0.0) return;
    const double share = std::clamp(done / total, 0.0, 1.0);
    const double elapsed_s = std::chrono::duration<double>{std::chrono::steady_clock::now() - started_}.count();
    const double left_s = share > 0.0 ? elapsed_s * (1.0 - share) / share : 0.0;
    const int filled = static_cast<int>(40.0 * share);
    fmt::print(stderr, "\r  [{:<40}] {:3.0f} %  {:.0f} s left  {} ", std::string(static_cast<std::size_t>(filled), '#'),
               100.0 * share, left_s, what);
    std::fflush(stderr);
    drawn_ = true;
  }

 private:
  bool terminal_ = isatty(STDERR_FILENO) != 0;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
};

}  // namespace trivela::cli
