#pragma once

#include <signal.h>
#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace trivela::e2e {

/// How long anything may take before a test gives up.
inline constexpr std::chrono::seconds kTimeout{240};

/// Something that becomes readable when a process ends. It may be anybody's child.
class ProcessWatch {
 public:
  /// Throws std::runtime_error where there is no such process.
  explicit ProcessWatch(pid_t id);
  ProcessWatch(ProcessWatch&& other) noexcept;
  ProcessWatch& operator=(ProcessWatch&&) = delete;
  ~ProcessWatch();

  pid_t id() const { return id_; }
  int file_descriptor() const { return descriptor_; }

  /// Whether it has ended, waiting up to the timeout for that.
  bool ended(std::chrono::milliseconds timeout) const;

 private:
  pid_t id_;
  int descriptor_;
};

/// One of the programs under test, in a folder of its own that is its working and its temporary directory too. What it
/// says is kept in files there.
class Program {
 public:
  /// Starts `name` of the build folder, or the program of that absolute path. `prepare`: what its process does last
  /// before, e.g. sets limits.
  Program(
      const std::string& name, std::vector<std::string> arguments, const std::filesystem::path& folder,
      const std::function<void()>& prepare = [] {});
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Kills it if it still runs.
  ~Program();

  pid_t id() const { return watch_->id(); }
  const ProcessWatch& watch() const { return *watch_; }
  void signal(int number) const { kill(id(), number); }

  /// Its exit code, or 128 + the signal that ended it, once it has ended. Throws std::runtime_error with what it said
  /// when that takes longer than kTimeout.
  int wait();

  std::string output() const;
  std::string errors() const;

 private:
  std::filesystem::path output_;
  std::filesystem::path errors_;
  std::optional<ProcessWatch> watch_;
  std::optional<int> status_;
};

/// The living children of a process.
std::vector<pid_t> children_of(pid_t parent);

/// The living processes that work in the folder.
std::vector<pid_t> processes_in(const std::filesystem::path& folder);

/// How the process was started, its program first; empty if it is gone.
std::vector<std::string> command_of(pid_t id);

/// The program's name, as it was started; empty if the process is gone.
std::string program_of(pid_t id);

/// Waits until `condition` holds, asking again whenever a file in `folder` changes. False: `process` ended first, or
/// kTimeout was over.
bool wait_for_change(const std::filesystem::path& folder, const ProcessWatch& process,
                     const std::function<bool()>& condition);

std::string text_of(const std::filesystem::path& file);

}  // namespace trivela::e2e
