#include "robot/recording/message_row.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "tests/evaluator/log_fixture.hpp"

namespace trivela::robot {
namespace {

using evaluator::log::Value;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Not;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

class MessageRowTest : public evaluator::LogTest {};

template <class T>
void expect_columns(evaluator::log::Writer& log, const std::string& table) {
  EXPECT_NO_THROW(log.table(table, columns_of<T>())) << table;
  EXPECT_EQ(row_of(T{}).size(), columns_of<T>().size()) << table;
}

TEST_F(MessageRowTest, TheLogHasAColumnForEveryField) {
  evaluator::log::Writer log{path(), session(), options()};
  expect_columns<msg::Odometry>(log, "odometry");
  expect_columns<msg::VisionFrame>(log, "vision_frames");
  expect_columns<msg::FlightFrame>(log, "flight_frames");
  expect_columns<msg::Referee>(log, "referee");
  expect_columns<msg::WorldState>(log, "world_states");
  expect_columns<msg::DriveCommand>(log, "drive_commands");
  expect_columns<msg::KickDecision>(log, "kick_decisions");
  expect_columns<msg::KickOrder>(log, "kick_orders");
  expect_columns<msg::KickReceipt>(log, "kick_receipts");
  expect_columns<msg::KickerStatus>(log, "kicker_status");
  expect_columns<msg::KickOutcome>(log, "kick_outcomes");
  expect_columns<msg::KickTruth>(log, "kick_truths");
  expect_columns<msg::PossessionTruth>(log, "possession_truths");
  std::vector<std::string> shadow{"robot_id", "seq", "shadow_index"};
  for (const auto& column : columns_of<msg::ShadowDecision>()) shadow.push_back(column);
  EXPECT_NO_THROW(log.table("shadow_decisions", shadow));
  EXPECT_ANY_THROW(log.table("odometry", columns_of<msg::DriveCommand>())) << "the check above means something";
}

TEST_F(MessageRowTest, CellsStandInTheOrderOfTheColumns) {
  EXPECT_THAT(columns_of<msg::Referee>(), ElementsAre("robot_id", "seq", "t_ns", "half", "playing", "possession_id"));
  msg::Referee referee{.robot_id = 3, .seq = 4, .t_ns = -5, .half = 2, .playing = true, .possession_id = 9};
  using Int = std::int64_t;
  EXPECT_THAT(row_of(referee),
              ElementsAre(Value{Int{3}}, Value{Int{4}}, Value{Int{-5}}, Value{Int{2}}, Value{Int{1}}, Value{Int{9}}));
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
  evaluator::log::Writer log{path(), session(), options()};
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
  const evaluator::log::Reader reader{path()};
  EXPECT_EQ(rows_of(reader, "odometry"), 1);
  EXPECT_EQ(rows_of(reader, "odometry WHERE wheel_3_radps IS NULL"), 1);
  EXPECT_EQ(loss_of(reader, "odometry").nan_refused, 1);
}

// Every message as a whole, written and read back.
TEST_F(MessageRowTest, ADecisionComesBackAsItWasWritten) {
  evaluator::log::Writer log{path(), session(), options()};
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
  const evaluator::log::Reader reader{path()};
  int rows = 0;
  reader.for_each_row("kick_decisions", columns_of<msg::KickDecision>(), [&](std::span<const Value> row) {
    ++rows;
    const auto columns = columns_of<msg::KickDecision>();
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
