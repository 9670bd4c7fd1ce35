#pragma once

#include <array>
#include <string>
#include <vector>

namespace trivela::cli {

/// What a feeder says on its standard output: settings by which its devices are found, "KEY=VALUE", then "t_s total_s"
/// lines of progress, of which the last one says "end".
class ProgressPipe {
 public:
  /// Throws std::runtime_error where the system has no pipe.
  ProgressPipe();
  ProgressPipe(const ProgressPipe&) = delete;
  ProgressPipe& operator=(const ProgressPipe&) = delete;
  ~ProgressPipe();

  int read_end() const { return ends_[0]; }
  int write_end() const { return ends_[1]; }
  void close_write_end();

  /// Takes what has come; true at the end of the stream.
  bool take();

  double played_s() const { return played_s_; }
  double total_s() const { return total_s_; }
  /// The settings before the first line of progress.
  const std::vector<std::string>& settings() const { return settings_; }
  /// A line of progress has come: the settings are complete.
  bool begun() const { return begun_; }
  /// The feeder has said that all was played.
  bool whole() const { return whole_; }

 private:
  void take_line(const std::string& line);

  std::array<int, 2> ends_{-1, -1};
  std::string text_;
  std::vector<std::string> settings_;
  double played_s_ = 0.0;
  double total_s_ = 0.0;
  bool begun_ = false;
  bool whole_ = false;
};

}  // namespace trivela::cli
