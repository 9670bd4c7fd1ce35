#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace trivela::faults {

/// How a process is started.
struct ProcessPlan {
  std::filesystem::path program;
  std::vector<std::string> arguments;
  std::map<std::string, std::string> environment;  ///< on top of ours
  std::filesystem::path says;                      ///< file that its standard output and error are added to
  int network = -1;                                ///< namespace to run in; -1: ours
  std::int64_t clock_ahead_ns = 0;                 ///< of CLOCK_MONOTONIC, in a time namespace; 0: ours
  int output = -1;                                 ///< standard output instead, e.g. a pipe's end
};

/// A process that the campaign does things to. It ends with the object, and with the campaign however that ends.
class NodeProcess {
 public:
  /// Throws std::runtime_error naming the program that cannot be started.
  explicit NodeProcess(const ProcessPlan& plan);
  NodeProcess(const NodeProcess&) = delete;
  NodeProcess& operator=(const NodeProcess&) = delete;
  ~NodeProcess();

  void signal(int number) const;

  /// SIGRTMIN with a value; several come one after the other.
  void tell(int value) const;

  int pid() const { return pid_; }

  /// Readable when it has ended.
  int file_descriptor() const { return pid_fd_; }

  /// Whether it has ended; never waits.
  bool ended();

  /// Exit code, or 128 + the signal; none: it still runs.
  std::optional<int> code();

 private:
  pid_t pid_ = -1;
  int pid_fd_ = -1;
  std::optional<int> status_;
};

}  // namespace trivela::faults
