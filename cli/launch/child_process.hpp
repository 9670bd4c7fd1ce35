#pragma once

#include <sys/types.h>

#include <chrono>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trivela::cli {

/// A process of ours: started with the object, gone with it. It stands in a process group of its own, so that Ctrl-C
/// reaches its launcher alone, and the kernel ends it if the launcher is killed.
class ChildProcess {
 public:
  /// Runs `program` with `arguments`. `output`: file descriptor for its standard output, or -1 to share ours.
  /// Throws std::runtime_error naming the program that cannot be started.
  ChildProcess(std::string name, const std::filesystem::path& program, const std::vector<std::string>& arguments,
               int output = -1);
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&&) = delete;

  /// Ends the process if it still runs: SIGTERM, then SIGKILL after five seconds.
  ~ChildProcess();

  const std::string& name() const { return name_; }

  /// Whether it has ended, and then how; never waits.
  bool ended();
  bool succeeded() { return ended() && status_ == 0; }

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
ChildProcess start_node(const std::string& node, const std::filesystem::path& config_file, int output = -1);

/// The end of a node that should run, as a sentence; empty if all do.
std::string dead_node(std::deque<ChildProcess>& nodes);

/// Ends them. Each is asked once, since a second signal would hit one that has stopped listening. The first `last` of
/// the list stop after the others, one after the other from behind: the recorder hears what the others say on their way
/// out. Returns what went wrong, a sentence each.
std::vector<std::string> stop_all(std::deque<ChildProcess>& nodes, std::size_t last);

/// From now on the node is this program with the node's name as its first argument.
void play_by_this_program(std::string_view node);

}  // namespace trivela::cli
