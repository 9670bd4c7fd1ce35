#pragma once

#include <unistd.h>

#include <array>
#include <csignal>
#include <string_view>

namespace trivela::cli {

/// SIGINT and SIGTERM while matches are computed. The first one asks to stop after the matches under way, and says so.
/// The second one ends the program at once: a policy may never answer. One at a time.
class StopRequest {
 public:
  StopRequest() {
    requested = 0;
    struct sigaction ours {};
    ours.sa_handler = take;
    ours.sa_flags = SA_RESTART;
    for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &ours, &before_[i]);
  }
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;
  ~StopRequest() {
    for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
  }

  static bool asked() { return requested != 0; }

 private:
  static constexpr std::array kSignals{SIGINT, SIGTERM};

  /// Calls nothing but what a signal may interrupt.
  static void take(int) {
    requested = 1;
    for (const int signal : kSignals) std::signal(signal, SIG_DFL);
    constexpr std::string_view kSays = "\ntrivela: stops after the matches under way; Ctrl-C once more stops at once\n";
    [[maybe_unused]] const auto written = write(STDERR_FILENO, kSays.data(), kSays.size());
  }

  static inline volatile std::sig_atomic_t requested = 0;
  std::array<struct sigaction, kSignals.size()> before_{};
};

}  // namespace trivela::cli
