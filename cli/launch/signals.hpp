#pragma once

#include <poll.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <string_view>
#include <system_error>

namespace trivela::cli {

/// SIGINT, SIGTERM, SIGHUP and SIGCHLD as something to poll; they do not interrupt anything else while it lives.
class SignalInbox {
 public:
  /// Throws std::system_error where no file descriptor is free.
  SignalInbox() {
    sigset_t ours;
    sigemptyset(&ours);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) sigaddset(&ours, signal);
    sigprocmask(SIG_BLOCK, &ours, &before_);
    descriptor_ = signalfd(-1, &ours, SFD_NONBLOCK | SFD_CLOEXEC);
    if (descriptor_ >= 0) return;
    const int reason = errno;
    sigprocmask(SIG_SETMASK, &before_, nullptr);
    throw std::system_error{reason, std::generic_category(), "cannot wait for signals"};
  }
  SignalInbox(const SignalInbox&) = delete;
  SignalInbox& operator=(const SignalInbox&) = delete;
  ~SignalInbox() {
    close(descriptor_);
    sigprocmask(SIG_SETMASK, &before_, nullptr);
  }

  int file_descriptor() const { return descriptor_; }

  /// Waits for a signal, so long at most; -1: for ever. True if somebody asked to stop.
  bool stop_requested_within(int timeout_ms) {
    pollfd inbox{descriptor_, POLLIN, 0};
    poll(&inbox, 1, timeout_ms);
    return stop_requested();
  }

  /// Empties the inbox; true if somebody asked to stop.
  bool stop_requested() {
    signalfd_siginfo info{};
    bool stop = false;
    while (read(descriptor_, &info, sizeof info) == static_cast<ssize_t>(sizeof info))
      stop = stop || info.ssi_signo != SIGCHLD;
    return stop;
  }

 private:
  sigset_t before_{};
  int descriptor_ = -1;
};

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
