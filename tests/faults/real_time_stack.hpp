#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "config/settings.hpp"
#include "tests/e2e/program.hpp"
#include "tests/support/folder.hpp"

namespace trivela::faults {

/// The session in the kick_id of kick_decision's kicks; kick_decision_second has the next.
inline constexpr std::uint32_t kFirstSession = 100;

/// Which nodes there are.
struct StackOptions {
  bool standby = false;      ///< kick_decision_second beside kick_decision
  bool one_process = false;  ///< chain in place of odometry, world_state and kick_decision
};

/// The simulator and all nodes of a robot as processes of their own in real time, in a folder of their own.
class RealTimeStack {
 public:
  /// Starts them and waits until rows are recorded; the simulator plays for `minutes`. Throws std::runtime_error with
  /// what they said where that does not happen.
  explicit RealTimeStack(double minutes, StackOptions options = {});
  RealTimeStack(const RealTimeStack&) = delete;
  RealTimeStack& operator=(const RealTimeStack&) = delete;

  const config::Settings& settings() const { return settings_; }
  std::filesystem::path log() const { return folder_ / "match.db"; }

  /// Waits until `condition` holds, asking again whenever something is written in the folder. False: it took longer
  /// than e2e::kTimeout, or the recorder ended.
  [[nodiscard]] bool wait_for(const std::function<bool()>& condition) const;

  /// Sends a program a signal.
  void signal(const std::string& program, int number) const;

  /// Starts a program again that has ended.
  void restart(const std::string& program);

  /// Those that have ended, with how and what they said last.
  std::string casualties();

  /// Asks all to stop, the recorder last; each one's exit code by its name.
  std::map<std::string, int> stop();

  /// Bytes on standard error by program.
  std::map<std::string, std::size_t> said() const;

  /// What a program has said on standard error.
  std::string errors_of(const std::string& program) const;

 private:
  void start(const std::string& node);
  std::unique_ptr<e2e::Program> new_program(const std::string& node) const;
  const e2e::Program& program(const std::string& name) const;

  tests::Folder folder_;
  config::Settings settings_;
  std::vector<std::pair<std::string, std::unique_ptr<e2e::Program>>> programs_;
};

/// Of a log: the longest run of world states, from the first drive command on, that no drive command answers.
std::int64_t most_worlds_without_drive(const std::filesystem::path& log);

}  // namespace trivela::faults
