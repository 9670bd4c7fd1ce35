#include "evaluator/learning/learned_fit.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <set>

#include "log/schema/row_digest.hpp"
#include "tests/evaluator/experiment_fixture.hpp"

namespace trivela::evaluator {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class PredictedKicksTest : public LogTest {
 protected:
  /// An experiment of an arm of its number: `matches` matches of three kicks of the predictive policy each.
  std::filesystem::path experiment(const std::string& name, std::uint32_t arm, std::uint32_t matches) {
    {
      TestExperiment log{path(name), matches};
      log.config = "arm = " + std::to_string(arm) + "\n";  // with the same one it would be the same kicks again
      log.robot_id = 1 + arm;
      for (std::uint32_t match = 0; match < matches; ++match) {
        log.begin();
        log.session(match, arm, "predictive", {{1, "predictive"}});
        for (int id = 1; id <= 3; ++id) log.possession(1, id, "predictive", 1.0, LoggedKick{});
        log.commit();
      }
      log.finish();
    }
    change(path(name), "UPDATE kick_decisions SET p_on_target = 0.5, power = 20.0");
    return path(name);
  }

  /// What a test wants to be otherwise in a log, as if it had been recorded so.
  void change(const std::filesystem::path& file, const std::string& sql) {
    SQLite::Database database{file.string(), SQLite::OPEN_READWRITE};
    database.exec(sql + "; DELETE FROM digests");
    std::vector<std::int64_t> sessions;
    SQLite::Statement query{database, "SELECT session_id FROM sessions"};
    while (query.executeStep()) sessions.push_back(query.getColumn(0).getInt64());
    log::RowDigests digests{database};
    for (const std::int64_t session : sessions) digests.write(session);
  }

  static std::vector<std::uint32_t> matches_of(const PredictedKicks& logged) {
    std::vector<std::uint32_t> matches;
    for (const PredictedKick& kick : logged.kicks) matches.push_back(kick.match);
    return matches;
  }
};

PredictedKicks read(const std::vector<std::filesystem::path>& logs) {
  return predicted_kicks(logs, PredictionSource::kInCharge);
}

TEST_F(PredictedKicksTest, ALogThatIsNamedTwiceCountsOnce) {
  const auto log = experiment("a.db", 0, 2);
  const auto copy = path("copy.db");
  std::filesystem::copy_file(log, copy);
  EXPECT_THAT(matches_of(read({log})), ElementsAre(0, 0, 0, 1, 1, 1));
  EXPECT_THAT(read({log}).remarks, IsEmpty());
  const PredictedKicks again = read({log, log, copy});
  EXPECT_THAT(matches_of(again), ElementsAre(0, 0, 0, 1, 1, 1));
  EXPECT_THAT(again.remarks, ElementsAre(HasSubstr("a.db: 2 of its sessions stand in an earlier log"),
                                         HasSubstr("copy.db: 2 of its sessions stand in an earlier log")));
}

TEST_F(PredictedKicksTest, TheSameSeedIsTheSameMatchInEveryLog) {
  const auto one = experiment("one.db", 0, 2);
  const auto other = experiment("other.db", 1, 3);
  const PredictedKicks both = read({one, other});
  EXPECT_THAT(matches_of(both), ElementsAre(0, 0, 0, 1, 1, 1, 0, 0, 0, 1, 1, 1, 2, 2, 2));
  EXPECT_THAT(both.remarks, IsEmpty());
}

TEST_F(PredictedKicksTest, AnotherScenarioOrSeedIsAnotherMatch) {
  const auto one = experiment("one.db", 0, 1);
  const auto world = experiment("world.db", 1, 1);
  change(world, "UPDATE sessions SET scenario = 'team'");
  const auto seed = experiment("seed.db", 2, 1);
  change(seed, "UPDATE sessions SET seed = 12345");
  EXPECT_THAT(matches_of(read({one, world, seed})), ElementsAre(0, 0, 0, 1, 1, 1, 2, 2, 2));
}

TEST_F(PredictedKicksTest, WithoutASeedTheMatchsNumberSaysWhichItIs) {
  const auto one = experiment("one.db", 0, 2);
  const auto other = experiment("other.db", 1, 2);
  for (const auto& log : {one, other}) change(log, "UPDATE sessions SET seed = NULL");
  EXPECT_THAT(matches_of(read({one, other})), ElementsAre(0, 0, 0, 1, 1, 1, 0, 0, 0, 1, 1, 1));
  for (const auto& log : {one, other}) change(log, "UPDATE sessions SET match_id = NULL");
  EXPECT_THAT(matches_of(read({one, other})), ElementsAre(0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3));
}

TEST_F(PredictedKicksTest, RobotsThatRecordTheSameMinutesPlayTheSameMatch) {
  const auto one = experiment("one.db", 0, 1);
  const auto other = experiment("other.db", 1, 1);
  const auto later = experiment("later.db", 2, 1);
  for (const auto& log : {one, other, later})
    change(log, "UPDATE sessions SET seed = NULL, match_id = NULL, simulated = 0");
  change(other, "UPDATE sessions SET realtime_offset_ns = realtime_offset_ns + 1000000000");
  change(later, "UPDATE sessions SET realtime_offset_ns = realtime_offset_ns + 3600000000000");
  EXPECT_THAT(matches_of(read({one, later, other})), ElementsAre(0, 0, 0, 1, 1, 1, 0, 0, 0));
}

}  // namespace
}  // namespace trivela::evaluator
