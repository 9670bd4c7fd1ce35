// A log of the first released schema stays readable.
#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "evaluator/log/reader.hpp"
#include "evaluator/report/render.hpp"
#include "tests/evaluator/log_fixture.hpp"

namespace trivela::evaluator {
namespace {

using log::Reader;
using log::Value;

/// A session of version 1 with a kick on target of each policy.
std::filesystem::path version_1_log(const std::filesystem::path& path) {
  std::filesystem::remove(path);
  SQLite::Database database(path.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  std::ifstream schema(TRIVELA_SOURCE_DIR "/tests/evaluator/version_1_schema.sql");
  database.exec("PRAGMA application_id = 0x4B49434B; PRAGMA user_version = 1;");
  database.exec(std::string(std::istreambuf_iterator<char>(schema), {}));
  database.exec(
      "INSERT INTO sessions VALUES (7, '00000000-0000-000e-8000-000000000000', 1, 0, 60000000000, 'simulated', 0, "
      "'a = 1', 'digest', 3, '0.1', 'default', 1, 'struct X {};');"
      "INSERT INTO session_policies VALUES (7, 1, 'stopped'), (7, 2, 'moving');");
  for (const int half : {1, 2}) {
    const std::string n = std::to_string(half);
    const std::string start = std::to_string((half - 1) * 30) + "000000000";
    const std::string end = std::to_string(half * 30) + "000000000";
    database.exec("INSERT INTO referee VALUES (7, 1, " + n + "0, " + start + ", " + n + ", 1, 1), (7, 1, " + n + "1, " +
                  end + ", " + n + ", 0, 1);");
    database.exec("INSERT INTO kick_decisions VALUES (7, 1, " + n + ", " + start + ", " + n + ", " + n + ", 1, '" +
                  (half == 1 ? "stopped" : "moving") +
                  "', 1, 'fire', 0, 3, 0, 0, 0, 0, 0, 9, 0.7, 5.7, 8, 8, 20, 0, 0, 1, 0, 0.1, 0.1, 0, 0.7, 0.8, 2, "
                  "1, 0);");
    database.exec("INSERT INTO kick_orders VALUES (7, 1, " + n + ", " + start + ", " + n + ", 20, " + start + ", " +
                  end + ");");
    database.exec("INSERT INTO kick_receipts VALUES (7, 1, " + n + ", " + start + ", " + n + ", 1, 'none', " + start +
                  ", " + start + ", " + end + ", 20);");
    database.exec("INSERT INTO kick_outcomes VALUES (7, 1, " + n + ", " + end + ", " + n +
                  ", 'on_target', 1, 0, 0.7, 0.05, 20, 8, 0.6);");
    database.exec("INSERT INTO kick_truths VALUES (7, 1, " + n + ", " + end + ", " + n + ", " + n +
                  ", 1, 'on_target', 0, 0.7, " + start + ", 0, 3, 0, 6, 4, 0.3);");
  }
  return path;
}

class Version1 : public LogTest {
 protected:
  const std::filesystem::path log_path = version_1_log(path("version_1.db"));
};

TEST_F(Version1, SaysWhatItSaid) {
  const Reader reader(log_path);
  const auto sessions = reader.sessions();
  ASSERT_EQ(sessions.size(), 1u);
  EXPECT_EQ(sessions[0].config_toml, "a = 1");
  EXPECT_EQ(sessions[0].config_sha256, "digest");
  EXPECT_EQ(sessions[0].idl, "struct X {};");
  EXPECT_EQ(sessions[0].seed, 3);
  EXPECT_FALSE(sessions[0].arm || sessions[0].kicker_table || sessions[0].match_id) << "it knows no experiments";
  const auto kicks = reader.kicks();
  ASSERT_EQ(kicks.size(), 2u);
  EXPECT_EQ(kicks[1].policy, "moving");
  EXPECT_EQ(kicks[1].observed->outcome, "on_target");
  EXPECT_EQ(kicks[1].truth->z_cross_m, 0.7);
}

TEST_F(Version1, WhatItDidNotHaveIsEmpty) {
  const Reader reader(log_path);
  int rows = 0;
  reader.for_each_row("assignments", {"policy", "probability"}, [&](std::span<const Value>) { ++rows; });
  EXPECT_EQ(rows, 0);
  reader.for_each_row("kick_decisions", {"policy", "p_on_target", "fire_after_s", "assignment_probability"},
                      [&](std::span<const Value> row) {
                        ++rows;
                        EXPECT_TRUE(std::holds_alternative<std::monostate>(row[1]));
                        EXPECT_EQ(std::get<double>(row[2]), 0.0);
                        EXPECT_EQ(std::get<double>(row[3]), 1.0);
                      });
  EXPECT_EQ(rows, 2);
  reader.for_each_row("kick_truths", {"saved"},
                      [&](std::span<const Value> row) { EXPECT_EQ(std::get<std::int64_t>(row[0]), 0); });
}

TEST_F(Version1, IsReportedOn) {
  const Report report = make_report(Reader(log_path));
  ASSERT_EQ(report.policies.size(), 2u);
  for (const PolicyRow& row : report.policies) {
    EXPECT_EQ(row.kicks(), 1) << row.policy;
    EXPECT_EQ(row.of("on_target"), 1) << row.policy;
    ASSERT_TRUE(row.played_min) << row.policy;
    EXPECT_DOUBLE_EQ(*row.played_min, 0.5) << row.policy;
  }
  EXPECT_EQ(report.alike_with_truth, 2);
  EXPECT_FALSE(to_text(report).empty());
}

}  // namespace
}  // namespace trivela::evaluator
