#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include "evaluator/counting/log_kicks.hpp"
#include "log/read/reader.hpp"
#include "log/write/writer.hpp"
#include "tests/evaluator/referee_row.hpp"
#include "tests/support/folder.hpp"

namespace trivela::evaluator {

/// What a comparison of these logs is made of.
inline KickDataset read_log_kicks(const std::vector<std::filesystem::path>& logs, const LogKicks& options,
                                  std::string& by) {
  return kick_dataset_of(read_opportunities(logs, options.truth), options, by);
}

/// A directory of its own for each test, with what most of them need.
class LogTest : public testing::Test {
 protected:
  std::filesystem::path path(const std::string& name = "match.db") const { return directory_ / name; }

  static log::Session session() {
    return {.uuid = "",
            .robot_id = 1,
            .started_t_ns = 20,
            .simulated_clock = true,
            .realtime_offset_ns = 0,
            .config_toml = "a = 1\n",
            .seed = 7,
            .software_version = "test",
            .scenario = "empty_field",
            .simulated = true,
            .idl = "struct X {};",
            .policies = {{1, "stopped"}, {2, "moving"}}};
  }

  /// Options that collect the warnings.
  log::WriterOptions options(std::size_t queue_capacity = 65536, double group_commit_s = 0.01) {
    return {.queue_capacity = queue_capacity,
            .group_commit_s = group_commit_s,
            .warn = [this](const std::string& sentence) {
              const std::lock_guard lock(mutex_);
              warnings_.push_back(sentence);
            }};
  }

  static log::TableId referee_table(log::Writer& writer) { return writer.table("referee", referee_columns()); }

  static std::vector<log::Value> referee_row(std::int64_t seq, std::int64_t half = 1, std::int64_t t_ns = -1) {
    return referee_cells(1, seq, t_ns < 0 ? seq * 20 : t_ns, half, true, 0);
  }

  static log::TableId drive_table(log::Writer& writer) {
    return writer.table("drive_commands", {"robot_id", "seq", "t_ns", "vx_mps", "vy_mps", "omega_radps"});
  }

  static std::vector<log::Value> drive_row(std::int64_t seq, double vx_mps) {
    return {std::int64_t{1}, seq, seq * 20, vx_mps, 0.0, 0.0};
  }

  static std::int64_t rows_of(const log::Reader& reader, const std::string& table) {
    std::int64_t n = 0;
    reader.query("SELECT count(*) FROM " + table,
                 [&](std::span<const log::Value> row) { n = std::get<std::int64_t>(row[0]); });
    return n;
  }

  static log::Loss loss_of(const log::Reader& reader, const std::string& stream) {
    for (const log::Loss& loss : reader.losses()) {
      if (loss.stream == stream) return loss;
    }
    return {};
  }

  tests::Folder directory_;
  std::mutex mutex_;
  std::vector<std::string> warnings_;
};

}  // namespace trivela::evaluator
