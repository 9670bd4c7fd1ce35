#include "robot/recording/message_row.hpp"

#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <regex>
#include <set>

#include "tests/evaluator/log_fixture.hpp"

namespace trivela::robot {
namespace {

using log::Value;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Not;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

class MessageRowTest : public evaluator::LogTest {};

/// What is said on the bus and stands in no log.
const std::set<std::string> kNotRecorded{"DeviceWheels", "DeviceGyro",   "DeviceDrive",    "DeviceKicker",
                                         "DeviceFire",   "DeviceCharge", "DeviceEmulated", "SimScan",
                                         "StepDone",     "TeamHeard",    "TeamState",      "KickerDrift"};

/// Calls f.operator()<T>(table) for each message with a table of the log.
template <class F>
void for_each_recorded(F&& f) {
  bus::for_each_message([&]<class T>() {
    if (const auto table = log::table_of_message(bus::meta<T>::name)) f.template operator()<T>(*table);
  });
  f.template operator()<msg::ShadowDecision>(table_of<msg::ShadowDecision>());
}

TEST_F(MessageRowTest, EveryTopicHasATableOrIsNamedAsNotRecorded) {
  std::set<std::string> without;
  bus::for_each_message([&]<class T>() {
    if (!log::table_of_message(bus::meta<T>::name)) without.emplace(bus::meta<T>::name);
  });
  EXPECT_EQ(without, kNotRecorded);
  EXPECT_EQ(table_of<msg::VisionFrame>(), "vision_frames");
  EXPECT_EQ(table_of<msg::KickerStatus>(), "kicker_status");
  EXPECT_THROW(table_of<msg::DeviceFire>(), std::logic_error);
}

TEST_F(MessageRowTest, ColumnsAreTheFieldsOfTheMessages) {
  log::Writer log{path(), session(), options()};
  log.finalise();
  const log::Reader reader{path()};
  for_each_recorded([&]<class T>(const std::string& table) {
    std::set<std::string> columns, fields;
    reader.query("SELECT name FROM pragma_table_info('" + table + "')",
                 [&](const std::string& name) { columns.insert(name); });
    columns.erase("session_id");
    for (const std::string& field : columns_of<T>()) fields.insert(field);
    if (table == "shadow_decisions") fields.insert({"robot_id", "seq", "shadow_index"});
    EXPECT_EQ(columns, fields) << table;
    EXPECT_EQ(row_of(T{}).size(), columns_of<T>().size()) << table;
  });
}

/// The labels that the schema allows in a column.
std::vector<std::string> labels_in_schema(const log::Reader& reader, const std::string& table,
                                          const std::string& column) {
  std::string sql;
  reader.query("SELECT sql FROM main.sqlite_schema WHERE name = '" + table + "'",
               [&](const std::string& text) { sql = text; });
  std::smatch check;
  if (!std::regex_search(sql, check, std::regex("\\b" + column + " TEXT NOT NULL CHECK \\(([^)]*)\\)"))) return {};
  const std::string inside = check[1];
  const std::regex one(column + " = '([a-z_]+)'");
  std::vector<std::string> labels;
  for (std::sregex_iterator label{inside.begin(), inside.end(), one}, end; label != end; ++label)
    labels.push_back((*label)[1]);
  return labels;
}

template <class Enum>
std::vector<std::string> labels_of() {
  std::vector<std::string> labels;
  for (const auto& enumerator : bus::enumeration<Enum>::enumerators) labels.emplace_back(enumerator.label);
  return labels;
}

TEST_F(MessageRowTest, TheSchemaAllowsTheLabelsOfTheMessages) {
  log::Writer log{path(), session(), options()};
  log.finalise();
  const log::Reader reader{path()};
  int enums = 0;
  for_each_recorded([&]<class T>(const std::string& table) {
    bus::visit_fields(T{}, [&](std::string_view name, std::string_view, const auto& field) {
      using Field = std::remove_cvref_t<decltype(field)>;
      if constexpr (bus::Enumeration<Field>) {
        ++enums;
        if (name == "policy") return;  // any name, or some of them as a shadow: log_schema_test
        EXPECT_EQ(labels_in_schema(reader, table, std::string(name)), labels_of<Field>()) << table << '.' << name;
      }
    });
  });
  EXPECT_GE(enums, 11);
}

// Whoever misses a stream with a period here takes a robot whose other streams went on for one that ended.
TEST_F(MessageRowTest, SilencesLookAtEveryStreamWithAPeriod) {
  std::ifstream file(TRIVELA_SOURCE_DIR "/evaluator/metrics/silences.sql");
  const std::string sql(std::istreambuf_iterator<char>(file), {});
  for_each_recorded([&]<class T>(const std::string& table) {
    if constexpr (bus::Message<T>) {
      const bool there = sql.find("'" + table + "', (SELECT t_ns FROM " + table + " AS o") != std::string::npos;
      EXPECT_EQ(there, bus::meta<T>::period_s > 0.0) << table;
    }
  });
}

TEST_F(MessageRowTest, ATableOfOtherColumnsIsRefused) {
  log::Writer log{path(), session(), options()};
  EXPECT_ANY_THROW(log.table("odometry", columns_of<msg::DriveCommand>()));
}

TEST_F(MessageRowTest, CellsStandInTheOrderOfTheColumns) {
  EXPECT_THAT(columns_of<msg::Referee>(),
              ElementsAre("robot_id", "seq", "t_ns", "half", "playing", "possession_id", "stage", "restart", "ours",
                          "goals_own", "goals_other", "command_counter", "half_time_s"));
  msg::Referee referee{.robot_id = 3,
                       .seq = 4,
                       .t_ns = -5,
                       .half = 2,
                       .playing = true,
                       .possession_id = 9,
                       .stage = msg::STAGE_SECOND_HALF,
                       .restart = msg::RESTART_CORNER,
                       .ours = true,
                       .goals_own = 6,
                       .goals_other = 7,
                       .command_counter = 8,
                       .half_time_s = 1.5};
  using Int = std::int64_t;
  EXPECT_THAT(row_of(referee),
              ElementsAre(Value{Int{3}}, Value{Int{4}}, Value{Int{-5}}, Value{Int{2}}, Value{Int{1}}, Value{Int{9}},
                          Value{std::string{"second_half"}}, Value{std::string{"corner"}}, Value{Int{1}}, Value{Int{6}},
                          Value{Int{7}}, Value{Int{8}}, Value{1.5}));
}

TEST_F(MessageRowTest, EnumsAreWrittenByTheirLabel) {
  msg::KickReceipt receipt{};
  receipt.refusal = msg::REFUSAL_OUT_OF_RANGE;
  EXPECT_THAT(row_of(receipt), Contains(Value{std::string{"out_of_range"}}));
  msg::KickOutcome outcome{};
  outcome.outcome = static_cast<msg::Outcome>(msg::OUTCOME_UNKNOWN + 1);
  EXPECT_THAT(row_of(outcome), Contains(Value{std::string{"invalid"}}));
}

TEST_F(MessageRowTest, ShadowsAreNoCellsOfTheDecision) {
  EXPECT_THAT(columns_of<msg::KickDecision>(), Not(Contains("shadows")));
  EXPECT_THAT(columns_of<msg::KickDecision>(), Contains("shadow_count"));
}

TEST_F(MessageRowTest, NaNBecomesNoValueWhereThatIsAllowedAndIsCountedElsewhere) {
  log::Writer log{path(), session(), options()};
  const auto table = log.table("odometry", columns_of<msg::Odometry>());
  msg::Odometry sample{};
  sample.robot_id = 1;
  sample.seq = 1;
  sample.wheel_3_radps = kNaN;
  EXPECT_TRUE(std::isnan(std::get<double>(row_of(sample)[6])));
  log.push(table, row_of(sample));
  sample.seq = 2;
  sample.vx_mps = kNaN;
  log.push(table, row_of(sample));
  log.finalise();
  const log::Reader reader{path()};
  EXPECT_EQ(rows_of(reader, "odometry"), 1);
  EXPECT_EQ(rows_of(reader, "odometry WHERE wheel_3_radps IS NULL"), 1);
  EXPECT_EQ(loss_of(reader, "odometry").nan_refused, 1);
}

// Every message as a whole, written and read back.
TEST_F(MessageRowTest, ADecisionComesBackAsItWasWritten) {
  log::Writer log{path(), session(), options()};
  const auto table = log.table("kick_decisions", columns_of<msg::KickDecision>());
  msg::KickDecision decision{};
  double next = 0.25;
  bus::visit_fields(decision, [&](std::string_view, std::string_view, auto& field) {
    if constexpr (std::is_floating_point_v<std::remove_reference_t<decltype(field)>>) field = next += 1.0;
  });
  decision.robot_id = 1;
  decision.seq = 1;
  decision.half = 1;
  decision.policy = msg::POLICY_MOVING;
  decision.reason = msg::REASON_NOT_ALIGNED;
  decision.opponent_distance_m = kNaN;
  const auto written = row_of(decision);
  log.push(table, written);
  log.finalise();
  const log::Reader reader{path()};
  int rows = 0;
  const auto columns = columns_of<msg::KickDecision>();
  reader.query(fmt::format("SELECT {} FROM kick_decisions", fmt::join(columns, ", ")), [&](std::span<const Value> row) {
    ++rows;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const auto* number = std::get_if<double>(&written[i]);
      if (number != nullptr && std::isnan(*number)) {
        EXPECT_TRUE(std::holds_alternative<std::monostate>(row[i])) << columns[i];
      } else {
        EXPECT_EQ(row[i], written[i]) << columns[i];
      }
    }
  });
  EXPECT_EQ(rows, 1);
}

}  // namespace
}  // namespace trivela::robot
