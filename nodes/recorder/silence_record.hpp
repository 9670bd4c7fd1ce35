#pragma once

#include <spdlog/logger.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "log/write/writer.hpp"
#include "robot/watch/silence_lines.hpp"
#include "robot/watch/silence_watch.hpp"

namespace trivela::nodes {

/// Writes a row for each silence of a stream to the log, when it begins and again when it ends, and warns of it. By the
/// samples' own t_ns: what merely came late to the recorder is no silence. For any thread.
class SilenceRecord {
 public:
  /// How often look() is to be called.
  static constexpr std::chrono::milliseconds kStep{20};

  /// Streams have at least the period of a cycle.
  SilenceRecord(std::shared_ptr<spdlog::logger> logger, double cycle_s, log::Writer& log)
      : logger_(std::move(logger)), cycle_s_(cycle_s), log_(log) {}

  /// The number of a stream, by the table of its samples, and with its period where it is new.
  std::size_t add(const std::string& table, double period_s);

  void heard(std::size_t stream, std::uint8_t robot_id, std::int64_t t_ns);
  void look(std::int64_t now_ns);

 private:
  void write(const robot::SilenceEdge& edge);

  const std::shared_ptr<spdlog::logger> logger_;
  const double cycle_s_;
  log::Writer& log_;
  std::mutex mutex_;  // of what follows
  std::vector<std::string> tables_;
  robot::SilenceWatch watch_{std::chrono::nanoseconds{kStep}.count()};
  robot::SilenceLines lines_;
};

}  // namespace trivela::nodes
