#include <gmock/gmock.h>

#include <fstream>

#include "calibration/rows/lobs_of_scans.hpp"
#include "tests/evaluator/scan_fixture.hpp"

namespace trivela::calibration {
namespace {

using kicking::lob::LobRecord;
using kicking::lob::Refusal;
using log::TestedSetPoint;
using log::Verdict;
using testing::HasSubstr;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

LobRecord lob_at(std::int64_t launch_t_ns, bool fitted = true) {
  LobRecord lob;
  lob.launch_t_ns = launch_t_ns;
  if (fitted) lob.effective.emplace();
  return lob;
}

std::optional<double> power_of(std::int64_t launch_t_ns, const std::vector<TestedSetPoint>& set_points) {
  LobRecord lob = lob_at(launch_t_ns);
  annotate(lob, set_points, {});
  return lob.power;
}

LobRecord judged(LobRecord lob, const std::vector<Verdict>& verdicts) {
  annotate(lob, {}, verdicts);
  return lob;
}

TEST(Annotate, ALobHasThePowerOfTheLastSetPointAtOrBeforeItsLaunch) {
  const std::vector<TestedSetPoint> set_points{{.t_ns = 10, .power = 15.0, .kick_id = 0},
                                               {.t_ns = 20, .power = 20.0, .kick_id = 0},
                                               {.t_ns = 30, .power = 25.0, .kick_id = 0}};
  EXPECT_EQ(power_of(9, set_points), std::nullopt);
  EXPECT_EQ(power_of(10, set_points), 15.0);
  EXPECT_EQ(power_of(29, set_points), 20.0);
  EXPECT_EQ(power_of(1000, set_points), 25.0);
  EXPECT_EQ(power_of(1000, {set_points[2], set_points[0]}), 25.0) << "by time, not by order";
  EXPECT_EQ(power_of(15, {set_points[0], {.t_ns = 10, .power = 17.0, .kick_id = 0}}), 17.0) << "corrected at once";
  EXPECT_EQ(power_of(35, {set_points[1], {.t_ns = 30, .power = std::nullopt, .kick_id = 0}}), std::nullopt)
      << "the plan was done";
}

TEST(Annotate, ARejectedLobIsRefusedByTheOperatorInItsWords) {
  const LobRecord lob = judged(lob_at(0), {{.launch_t_ns = 0, .accepted = false, .why = "a foot"}});
  EXPECT_EQ(lob.refusal, Refusal::kOperator);
  EXPECT_EQ(lob.why, "rejected by the operator: a foot");
  EXPECT_EQ(judged(lob_at(0), {{.launch_t_ns = 0, .accepted = false, .why = ""}}).why, "rejected by the operator");
}

TEST(Annotate, AnAcceptedLobLosesItsRefusalOnlyWhereThereIsAFit) {
  for (const bool fitted : {true, false}) {
    LobRecord lob = lob_at(0, fitted);
    lob.refusal = Refusal::kOneSideOfApex;
    lob.why = "one side";
    lob = judged(lob, {{.launch_t_ns = 0, .accepted = true, .why = ""}});
    EXPECT_EQ(lob.refusal, fitted ? Refusal::kNone : Refusal::kOneSideOfApex);
    EXPECT_EQ(lob.why, fitted ? "" : "one side");
  }
}

TEST(Annotate, TheLastWordCounts) {
  const Verdict no{.launch_t_ns = 0, .accepted = false, .why = ""};
  const Verdict yes{.launch_t_ns = 0, .accepted = true, .why = ""};
  EXPECT_EQ(judged(lob_at(0), {no, yes}).refusal, Refusal::kNone);
  EXPECT_EQ(judged(lob_at(0), {no, yes, no}).refusal, Refusal::kOperator);
}

TEST(Annotate, AVerdictFindsTheLobWithinHalfASecond) {
  for (const std::int64_t off_ns : {-kSecond_ns / 2, kSecond_ns / 2}) {
    EXPECT_EQ(judged(lob_at(off_ns), {{.launch_t_ns = 0, .accepted = false, .why = ""}}).refusal, Refusal::kOperator);
  }
  for (const std::int64_t off_ns : {-kSecond_ns / 2 - 1, kSecond_ns / 2 + 1}) {
    EXPECT_EQ(judged(lob_at(off_ns), {{.launch_t_ns = 0, .accepted = false, .why = ""}}).refusal, Refusal::kNone);
  }
}

using LobVerdicts = evaluator::ScanTest;

TEST_F(LobVerdicts, StandBesideTheRecord) {
  const auto record = path("scans.db");
  EXPECT_TRUE(verdicts_beside(record).empty()) << "no file, no verdicts";
  write_verdicts(record,
                 std::vector<Verdict>{{.launch_t_ns = 1'700'000'000'000'000'001, .accepted = false, .why = "\"ü\""},
                                      {.launch_t_ns = -5, .accepted = true, .why = ""}});
  const auto read = verdicts_beside(record);
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].launch_t_ns, 1'700'000'000'000'000'001);
  EXPECT_FALSE(read[0].accepted);
  EXPECT_EQ(read[0].why, "\"ü\"");
  EXPECT_TRUE(read[1].accepted);
  EXPECT_EQ(verdicts_path(record), path("scans.db.verdicts.json"));
  for (const auto& entry : std::filesystem::directory_iterator(record.parent_path()))
    EXPECT_NE(entry.path().extension(), ".new") << entry.path();
}

TEST_F(LobVerdicts, AFileThatIsSomethingElseIsNamed) {
  for (const char* const text : {"", "[", "[{}]", "[{\"launch_t_ns\": 1, \"accepted\": 7, \"why\": \"\"}]", "[1]"}) {
    std::ofstream(path("scans.db.verdicts.json")) << text;
    try {
      verdicts_beside(path("scans.db"));
      ADD_FAILURE() << text;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), HasSubstr("scans.db.verdicts.json does not hold verdicts"));
    }
  }
}

TEST_F(LobVerdicts, AFolderThatCannotBeWrittenIsNamed) {
  try {
    write_verdicts(path("no/scans.db"), {});
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("cannot write the verdicts " + path("no/scans.db.verdicts.json").string()));
  }
}

}  // namespace
}  // namespace trivela::calibration
