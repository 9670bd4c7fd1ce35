#pragma once

#include <map>
#include <string>

#include "tests/e2e/program.hpp"
#include "tests/support/folder.hpp"

namespace trivela::e2e {

/// A match in a folder of its own that would go on for long, more than 100 cycles of which are in its log.
class RunningMatch {
 public:
  /// Throws std::runtime_error if the match ended instead, with what it said.
  explicit RunningMatch(std::vector<std::string> more_arguments = {});

  /// Waits until `bytes` of rows have been written since the match began. False: the match ended.
  bool wait_until_recorded(std::uintmax_t bytes) const;

  Program& program() { return program_; }
  const tests::Folder& folder() const { return folder_; }
  std::filesystem::path log() const { return folder_ / "match.db"; }

  /// The configuration that all nodes read, while the recorder lives.
  std::filesystem::path config() const;

  /// The node processes by program, e.g. "trivela-recorder".
  const ProcessWatch& node(const std::string& program) const { return nodes_.at(program); }
  const std::map<std::string, ProcessWatch>& nodes() const { return nodes_; }

  /// Programs of the nodes that have not ended within the timeout.
  std::vector<std::string> nodes_left(std::chrono::milliseconds timeout) const;

 private:
  tests::Folder folder_;
  Program program_;
  std::map<std::string, ProcessWatch> nodes_;
};

}  // namespace trivela::e2e
