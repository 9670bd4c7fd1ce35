// Logs of every released schema stay readable.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "calibration/rows/drive_rows.hpp"
#include "evaluator/learning/predicted_kicks.hpp"
#include "evaluator/log/reader.hpp"
#include "evaluator/log/scan_log.hpp"
#include "evaluator/report/log_kicks.hpp"
#include "evaluator/report/table2.hpp"
#include "tests/evaluator/log_fixture.hpp"
#include "tests/evaluator/older_log.hpp"

namespace trivela::evaluator {
namespace {

using log::Reader;
using log::Value;
using testing::HasSubstr;

class OlderLog : public LogTest, public testing::WithParamInterface<int> {
 protected:
  const std::filesystem::path log_path = older_match_log(path("older.db"), GetParam());
  const std::string second_policy = GetParam() == 1 ? "moving" : "predictive";
};

TEST_P(OlderLog, SaysWhatItSaid) {
  const Reader reader(log_path);
  const auto sessions = reader.sessions();
  ASSERT_EQ(sessions.size(), 1u);
  const auto whole = reader.whole(sessions[0]);
  EXPECT_EQ(whole.config_toml, "a = 1");
  EXPECT_EQ(sessions[0].config_sha256, log::sha256("a = 1"));
  EXPECT_EQ(whole.idl, "struct X {};");
  EXPECT_EQ(sessions[0].seed, 3);
  EXPECT_FALSE(sessions[0].arm || sessions[0].kicker_table || sessions[0].match_id) << "no experiment";
  const auto kicks = reader.kicks();
  ASSERT_EQ(kicks.size(), 2u);
  EXPECT_EQ(kicks[1].policy, second_policy);
  EXPECT_EQ(kicks[1].observed->outcome, "on_target");
  EXPECT_EQ(kicks[1].truth->z_cross_m, 0.7);
}

TEST_P(OlderLog, WhatItDidNotHaveIsEmpty) {
  const Reader reader(log_path);
  std::vector<const char*> tables{"assignments",     "continued",          "experiments",  "clock_offsets",
                                  "session_clocks",  "merged_sessions",    "labels",       "notes",
                                  "session_tallies", "possession_tallies", "order_tallies"};
  if (GetParam() < log::kFirstWithDigests) tables.push_back("digests");
  for (const char* const table : tables) EXPECT_EQ(rows_of(reader, table), 0) << table;
  int rows = 0;
  reader.for_each_row("kick_decisions", {"fire_after_s", "assignment_probability"}, [&](std::span<const Value> row) {
    ++rows;
    EXPECT_EQ(std::get<double>(row[0]), 0.0);
    EXPECT_EQ(std::get<double>(row[1]), 1.0);
  });
  reader.for_each_row("kick_truths", {"saved"},
                      [&](std::span<const Value> row) { EXPECT_EQ(std::get<std::int64_t>(row[0]), 0); });
  reader.for_each_row("kick_receipts", {"received_steady_ns", "fired_steady_ns"},
                      [&](std::span<const Value> row) { EXPECT_EQ(std::get<std::int64_t>(row[0]), 0); });
  reader.for_each_row("losses", {"robot_id", "from_t_ns", "to_t_ns"}, [&](std::span<const Value> row) {
    ++rows;
    EXPECT_EQ(std::get<std::int64_t>(row[0]), 0);
    EXPECT_TRUE(std::holds_alternative<std::monostate>(row[2]));
  });
  reader.for_each_row("referee", {"stage", "restart", "goals_own", "command_counter", "half_time_s"},
                      [&](std::span<const Value> row) {
                        ++rows;
                        EXPECT_EQ(std::get<std::string>(row[0]), "unknown");
                        EXPECT_EQ(std::get<std::string>(row[1]), "none");
                        EXPECT_EQ(std::get<std::int64_t>(row[2]), 0);
                        EXPECT_EQ(std::get<std::int64_t>(row[3]), 0) << "nobody counted";
                        EXPECT_TRUE(std::holds_alternative<std::monostate>(row[4]));
                      });
  reader.for_each_row("kick_orders", {"possession"},
                      [&](std::span<const Value> row) { EXPECT_EQ(std::get<std::int64_t>(row[0]), 1); });
  reader.for_each_row("kicker_status", {"state", "charge_modelled", "voltage_v"}, [&](std::span<const Value> row) {
    ++rows;
    EXPECT_EQ(std::get<std::string>(row[0]), "ready");
    EXPECT_EQ(std::get<std::int64_t>(row[1]), 0);
    EXPECT_TRUE(std::holds_alternative<std::monostate>(row[2]));
  });
  reader.for_each_row("odometry", {"obeyed"}, [&](std::span<const Value> row) {
    ++rows;
    EXPECT_EQ(std::get<std::string>(row[0]), "kick_decision");
  });
  EXPECT_EQ(rows_of(reader, "team_drives"), 0);
  EXPECT_EQ(rows, 11);
}

TEST_P(OlderLog, IsReportedOn) {
  const Report report = make_report(Reader(log_path));
  ASSERT_EQ(report.policies.size(), 2u);
  for (const PolicyRow& row : report.policies) {
    EXPECT_EQ(row.kicks(), 1) << row.policy;
    EXPECT_EQ(row.of("on_target"), 1) << row.policy;
    ASSERT_TRUE(row.played_min) << row.policy;
    EXPECT_DOUBLE_EQ(*row.played_min, 0.5) << row.policy;
  }
  EXPECT_EQ(report.alike_with_truth, 2);
  EXPECT_THAT(to_text(report), HasSubstr(GetParam() < log::kFirstWithDigests
                                             ? "not verified: a match log of version " + std::to_string(GetParam())
                                             : "verified: 22 rows are as they were recorded"));
}

TEST_P(OlderLog, IsComparedAndCalibratedFrom) {
  std::string by;
  EXPECT_EQ(read_log_kicks({log_path}, {}, by).opportunities.size(), 2u);
  EXPECT_NO_THROW(calibration::release_delays(calibration::recorded_drives(Reader(log_path))));
}

TEST_P(OlderLog, AConfigurationThatIsNotTheNamedOneIsDamage) {
  SQLite::Database(log_path.string(), SQLite::OPEN_READWRITE)
      .exec(GetParam() == 1 ? "UPDATE sessions SET config_toml = 'a = 2'"
                            : "UPDATE texts SET text = 'a = 2' WHERE text = 'a = 1'");
  try {
    const Reader reader(log_path);
    FAIL() << "it was read";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("has the SHA-256 " + log::sha256("a = 2")));
  }
}

INSTANTIATE_TEST_SUITE_P(Version, OlderLog, testing::Values(1, 2, 3, 4, 5, 6, 7));

using Version2 = LogTest;

TEST_F(Version2, IsLearnedFrom) {
  const auto kicks = predicted_kicks({older_match_log(path("older.db"), 2)}, PredictionSource::kInCharge);
  EXPECT_EQ(kicks.kicks.size(), 1u);
}

using OlderScans = LogTest;

TEST_F(OlderScans, AreRead) {
  SQLite::Database database = older_file(path("scans.db"), 0x5343414E, 1, "scan_schema_version_1.sql");
  database.exec(
      "INSERT INTO sessions VALUES (7, '00000000-0000-000e-8000-000000000000', 0, 9, 0, 'SICK', 'TiM', '1', '2', "
      "'CoLa', "
      "2, 0, 0.01, 0.0001, 0.02, 0.05, 10, 1, 0.5, 0, 0, 1, 'synthetic', '0.1');"
      "INSERT INTO scans VALUES (7, 0, 5, x'D00F02');"
      "INSERT INTO set_points VALUES (7, 0, 1, 20, 3);"
      "INSERT INTO verdicts VALUES (7, 0, 5, 0, 'bounced');"
      "INSERT INTO losses VALUES (7, 'scans', 3, 0, 0, 2, 0, 0, 0);");
  const log::ScanReader reader(path("scans.db"));
  ASSERT_EQ(reader.size(), 1u);
  EXPECT_THAT(reader.scan(0).range_mm, testing::ElementsAre(1000, 1001));
  EXPECT_EQ(reader.set_points().at(0).power, 20.0);
  EXPECT_EQ(reader.verdicts().at(0).why, "bounced");
  EXPECT_THAT(reader.warnings(), testing::ElementsAre("scans: 2 rows are missing"));
}

}  // namespace
}  // namespace trivela::evaluator
