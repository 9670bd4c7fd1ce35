#pragma once

#include <fmt/core.h>
#include <sys/mman.h>
#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <deque>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace trivela::cli {

/// A process of ours: started with the object, gone with it. It stands in a process group of its own, so that Ctrl-C
/// reaches its launcher alone, and the kernel ends it if the launcher is killed.
class ChildProcess {
 public:
  static constexpr int kOurs = -1;    ///< its standard output is ours
  static constexpr int kNobody = -2;  ///< nobody reads it

  /// Runs `program` with `arguments`. `output`: file descriptor for its standard output, or one of these.
  /// Throws std::runtime_error naming the program that cannot be started.
  ChildProcess(std::string name, const std::filesystem::path& program, const std::vector<std::string>& arguments,
               int output = kOurs);
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&&) = delete;

  /// Ends the process if it still runs: SIGTERM, then SIGKILL after five seconds.
  ~ChildProcess();

  const std::string& name() const { return name_; }

  /// Whether it has ended, and then how; never waits.
  bool ended();
  bool succeeded() { return ended() && status_ == 0; }
  /// It ended as one that was asked to: well, or by SIGTERM where it did not listen yet.
  bool stopped() { return succeeded() || status_ == SIGTERM; }

  /// "exit code 1", "signal 9 (Killed)".
  std::string how_it_ended() const;

  /// Asks it to stop.
  void terminate() const;

  /// Waits up to `timeout` for it to end.
  bool wait(std::chrono::milliseconds timeout);

 private:
  std::string name_;
  pid_t pid_ = -1;
  int pid_fd_ = -1;
  std::optional<int> status_;
};

/// Starts the node, named without "trivela-", with this configuration file: the program beside this one, else the one
/// on the PATH. `output`: as of ChildProcess.
ChildProcess start_node(const std::string& node, const std::filesystem::path& config_file,
                        int output = ChildProcess::kOurs);

/// The end of a node that should run, as a sentence; empty if all do.
std::string dead_node(std::deque<ChildProcess>& nodes);

/// Ends them. Each is asked once, since a second signal would hit one that has stopped listening. The first `last` of
/// the list stop after the others, one after the other from behind: the recorder hears what the others say on their way
/// out. Returns what went wrong, a sentence each.
std::vector<std::string> stop_all(std::deque<ChildProcess>& nodes, std::size_t last);

/// From now on the node is this program with the node's name as its first argument.
void play_by_this_program(std::string_view node);

/// A configuration in memory that this process and those it starts read by a name, and that is gone with the last of
/// them, however they end: no file of it is in any folder.
class ConfigFile {
 public:
  /// Throws std::runtime_error saying why it cannot be kept.
  explicit ConfigFile(const std::string& text) : descriptor_(memfd_create("trivela.toml", 0)) {
    for (std::size_t written = 0; descriptor_ >= 0 && written < text.size();) {
      const ssize_t n = write(descriptor_, text.data() + written, text.size() - written);
      if (n > 0) written += static_cast<std::size_t>(n);
      if (n <= 0 && errno != EINTR) release();
    }
    if (descriptor_ < 0)
      throw std::runtime_error{fmt::format("cannot keep the configuration for the nodes: {}", std::strerror(errno))};
  }
  ConfigFile(const ConfigFile&) = delete;
  ConfigFile& operator=(const ConfigFile&) = delete;
  ~ConfigFile() { release(); }

  /// The same in this process and in those that it starts while the object lives.
  std::filesystem::path path() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

 private:
  void release() {
    const int reason = errno;
    if (descriptor_ >= 0) close(descriptor_);
    descriptor_ = -1;
    errno = reason;
  }

  int descriptor_;  // without CLOEXEC
};

}  // namespace trivela::cli
