#pragma once

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace trivela::nodes {

/// A program in a process of its own, with all that it says. Killed and reaped when it goes out of scope.
class Spawned {
 public:
  Spawned(const std::string& program, const std::vector<std::string>& arguments) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("pipe2");
    output_ = ends[0];
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
    std::vector<char*> argv{const_cast<char*>(program.c_str())};
    for (const auto& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    const int failed = ::posix_spawn(&pid_, program.c_str(), &actions, nullptr, argv.data(), ::environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    if (failed != 0) throw std::runtime_error("cannot start " + program);
  }
  Spawned(const Spawned&) = delete;
  Spawned& operator=(const Spawned&) = delete;
  ~Spawned() {
    if (!status_) {
      ::kill(pid_, SIGKILL);
      ::waitpid(pid_, nullptr, 0);
    }
    ::close(output_);
    if (end_ >= 0) ::close(end_);
  }

  pid_t pid() const { return pid_; }
  /// Readable once the process has ended; -1: the system cannot say.
  int end() {
    if (end_ < 0) end_ = static_cast<int>(::syscall(SYS_pidfd_open, pid_, 0));
    return end_;
  }
  void send(int signal) const { ::kill(pid_, signal); }

  /// Its exit code, -1 if it died of a signal or does not end within 30 s.
  int exit_code() {
    while (read_some(std::chrono::seconds{30})) {
    }
    if (!closed_) return -1;
    int status = 0;
    if (!status_ && ::waitpid(pid_, &status, 0) == pid_) status_ = status;
    return status_ && WIFEXITED(*status_) ? WEXITSTATUS(*status_) : -1;
  }

  /// Waits for the text in what it says.
  bool says(const std::string& text) {
    while (said_.find(text) == std::string::npos) {
      if (!read_some(std::chrono::seconds{30})) return false;
    }
    return true;
  }
  const std::string& said() const { return said_; }

 private:
  bool read_some(std::chrono::milliseconds timeout) {
    pollfd output{output_, POLLIN, 0};
    if (closed_ || ::poll(&output, 1, static_cast<int>(timeout.count())) <= 0) return false;
    char buffer[4096];
    const ssize_t n = ::read(output_, buffer, sizeof buffer);
    if (n > 0) said_.append(buffer, static_cast<std::size_t>(n));
    closed_ = n == 0;
    return n > 0;
  }

  pid_t pid_ = -1;
  int output_ = -1;
  int end_ = -1;
  bool closed_ = false;
  std::optional<int> status_;
  std::string said_;
};

}  // namespace trivela::nodes
