#pragma once

#include <deque>
#include <map>
#include <set>
#include <string>

#include "config/settings.hpp"
#include "tests/e2e/folder.hpp"
#include "tests/e2e/program.hpp"

namespace trivela::faults {

/// The simulator and all nodes of a robot as processes of their own in real time, in a folder of their own.
class RealTimeStack {
 public:
  /// Starts them and waits until rows are recorded; the simulator plays for `minutes`. Throws std::runtime_error with
  /// what they said where that does not happen.
  explicit RealTimeStack(double minutes);
  RealTimeStack(const RealTimeStack&) = delete;
  RealTimeStack& operator=(const RealTimeStack&) = delete;

  const config::Settings& settings() const { return settings_; }
  std::filesystem::path log() const { return folder_ / "match.db"; }

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

  e2e::Folder folder_;
  config::Settings settings_;
  std::deque<std::pair<std::string, e2e::Program>> programs_;
};

}  // namespace trivela::faults
