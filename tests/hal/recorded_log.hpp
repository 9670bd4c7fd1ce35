#pragma once

#include <stdlib.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "evaluator/log/writer.hpp"

namespace trivela::hal {

/// A match log of one robot in a directory of its own.
class RecordedLog {
 public:
  RecordedLog() {
    std::string pattern = (std::filesystem::temp_directory_path() / "trivela_hal_XXXXXX").string();
    directory_ = ::mkdtemp(pattern.data());
    writer_ = std::make_unique<evaluator::log::Writer>(file(), evaluator::log::Session{.uuid = "",
                                                                                       .robot_id = 3,
                                                                                       .started_t_ns = 0,
                                                                                       .simulated_clock = true,
                                                                                       .realtime_offset_ns = 0,
                                                                                       .config_toml = "",
                                                                                       .seed = 1,
                                                                                       .software_version = "test",
                                                                                       .scenario = "test",
                                                                                       .simulated = true,
                                                                                       .idl = "",
                                                                                       .policies = {}});
  }
  ~RecordedLog() {
    writer_.reset();
    std::filesystem::remove_all(directory_);
  }
  RecordedLog(const RecordedLog&) = delete;
  RecordedLog& operator=(const RecordedLog&) = delete;

  std::filesystem::path file() const { return directory_ / "match.db"; }

  /// One row; NaN stands for NULL.
  void row(const std::string& table, const std::vector<std::string>& columns,
           std::vector<evaluator::log::Value> values) {
    writer_->push(writer_->table(table, columns), std::move(values));
  }

  void wheels(std::int64_t robot_id, std::int64_t seq, std::int64_t t_ns, const std::vector<double>& wheel_radps,
              double gyro_radps) {
    std::vector<std::string> columns{"robot_id",      "seq",           "t_ns",          "wheel_0_radps",
                                     "wheel_1_radps", "wheel_2_radps", "wheel_3_radps", "gyro_radps"};
    std::vector<evaluator::log::Value> values{robot_id, seq, t_ns};
    for (std::size_t i = 0; i < 4; ++i) values.emplace_back(i < wheel_radps.size() ? wheel_radps[i] : std::nan(""));
    values.emplace_back(gyro_radps);
    for (const char* belief : {"vx_mps", "vy_mps", "omega_radps", "x_m", "y_m", "heading_rad", "var_v_m2ps2",
                               "var_omega_rad2ps2", "var_position_m2", "var_heading_rad2"}) {
      columns.emplace_back(belief);
      values.emplace_back(0.0);
    }
    columns.emplace_back("obeyed");
    values.emplace_back("kick_decision");
    row("odometry", columns, std::move(values));
  }

  void kicker(std::int64_t robot_id, std::int64_t seq, std::int64_t t_ns, double charge, bool armed,
              const std::string& fault) {
    row("kicker_status",
        {"robot_id", "seq", "t_ns", "charge", "armed", "ready", "fault", "last_kick_id", "last_accepted",
         "orders_handled", "orders_refused", "state", "charge_modelled"},
        {robot_id, seq, t_ns, charge, std::int64_t{armed}, std::int64_t{0}, fault, std::int64_t{0}, std::int64_t{0},
         std::int64_t{0}, std::int64_t{0}, std::string{"off"}, std::int64_t{0}});
  }

  /// Ends the recording: the log can be read.
  void close() {
    writer_->finalise();
    writer_.reset();
  }

 private:
  std::filesystem::path directory_;
  std::unique_ptr<evaluator::log::Writer> writer_;
};

}  // namespace trivela::hal
