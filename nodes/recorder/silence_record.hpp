#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "evaluator/log/writer.hpp"
#include "nodes/runtime/node_context.hpp"
#include "nodes/runtime/silence_lines.hpp"
#include "nodes/runtime/silence_watch.hpp"

namespace trivela::nodes {

/// Writes a row for each silence of a stream to the log, when it begins and again when it ends, and warns of it. By the
/// samples' own t_ns: what merely came late to the recorder is no silence. For any thread.
class SilenceRecord {
 public:
  /// How often look() is to be called.
  static constexpr std::chrono::milliseconds kStep{20};

  SilenceRecord(const NodeContext& context, evaluator::log::Writer& log) : context_(context), log_(log) {}

  /// One more stream: the table of its samples, and its period.
  std::size_t add(const std::string& table, double period_s);

  void heard(std::size_t stream, std::uint8_t robot_id, std::int64_t t_ns);
  void look(std::int64_t now_ns);

 private:
  void write(const SilenceEdge& edge);

  const NodeContext& context_;
  evaluator::log::Writer& log_;
  std::mutex mutex_;  // of what follows
  std::vector<std::string> tables_;
  SilenceWatch watch_{std::chrono::nanoseconds{kStep}.count()};
  SilenceLines lines_;
};

}  // namespace trivela::nodes
