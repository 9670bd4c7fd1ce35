#include "nodes/recorder/log_place.hpp"
#include "kicking/geometry/time.hpp"

#include <gmock/gmock.h>

#include <fstream>

#include "log/read/reader.hpp"
#include "nodes/recorder/recorder_node.hpp"
#include "nodes/runtime/node_context.hpp"
#include "robot/recording/log_family.hpp"
#include "tests/nodes/node_fixture.hpp"
#include "tests/support/folder.hpp"

namespace trivela::nodes {
namespace {

using log::Reader;
using log::Session;
using log::Writer;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class LogPlaceTest : public NodeTest {
 protected:
  LogPlaceTest() {
    context.settings.recorder.log = folder / "match.db";
    context.settings.run.scenario = TRIVELA_SOURCE_DIR "/config/scenarios/default.toml";
  }
  PlacedLog place() { return place_log(context, {}); }

  /// A recording of the fixture's set-up, with the driver's last counters.
  std::string record(const std::filesystem::path& path, std::int64_t handled, double ago_s = 0.0) {
    Session session = session_of(context);
    session.realtime_offset_ns -= kicking::nanoseconds(ago_s);
    Writer log{path, session, {}};
    const auto statuses =
        log.table("kicker_status", {"robot_id", "seq", "t_ns", "charge", "armed", "ready", "fault", "last_kick_id",
                                    "last_accepted", "orders_handled", "orders_refused", "state", "charge_modelled"});
    const std::int64_t t_ns = session.started_t_ns + 1;
    for (const std::int64_t n : {std::int64_t{0}, handled})
      log.push(statuses, {std::int64_t{1}, n + 1, t_ns, 1.0, std::int64_t{1}, std::int64_t{1}, "none", std::int64_t{0},
                          std::int64_t{0}, n, std::int64_t{0}, "ready", std::int64_t{0}});
    log.finalise();
    return Reader{path}.sessions().at(0).uuid;
  }

  tests::Folder folder;
};

TEST_F(LogPlaceTest, AFreeNameIsTakenAndContinuesNothing) {
  const auto placed = place();
  EXPECT_EQ(placed.path, folder / "match.db");
  EXPECT_EQ(Reader{placed.path}.sessions().at(0).continues_uuid, "");
}

TEST_F(LogPlaceTest, WhereALogExistsTheSessionGoesOnFromItInAFileOfItsOwn) {
  const std::string uuid = record(folder / "match.db", 7);
  const auto placed = place();
  EXPECT_THAT(placed.path.filename().string(), testing::MatchesRegex("match-r1-[0-9]+T[0-9]+Z\\.db"));
  EXPECT_TRUE(log_lines->wait_for("match.db exists already"));
  EXPECT_TRUE(log_lines->wait_for(placed.path.filename().string()));
  const Reader log{placed.path};
  EXPECT_EQ(log.sessions().at(0).continues_uuid, uuid);
  std::vector<std::int64_t> counts;
  log.query("SELECT robot_id, orders_handled, orders_refused FROM continued",
            [&](std::int64_t robot_id, std::int64_t handled, std::int64_t refused) {
              counts.insert(counts.end(), {robot_id, handled, refused});
            });
  EXPECT_THAT(counts, testing::ElementsAre(1, 7, 0));
}

TEST_F(LogPlaceTest, RecordersOfTheSameSecondHaveFilesOfTheirOwn) {
  record(folder / "match.db", 1);
  std::set<std::filesystem::path> paths;
  std::vector<PlacedLog> placed;
  for (int i = 0; i < 4; ++i) paths.insert(placed.emplace_back(place()).path);
  EXPECT_THAT(paths, SizeIs(4));
}

TEST_F(LogPlaceTest, ASessionThatSaidNothingHandsOnWhereItBegan) {
  record(folder / "match.db", 7);
  const auto second = place();
  second.writer->finalise();
  const auto third = place();
  const auto second_uuid = Reader{second.path}.sessions().at(0).uuid;
  EXPECT_EQ(Reader{third.path}.sessions().at(0).continues_uuid, second_uuid);
  std::int64_t handled = 0;
  Reader{third.path}.query("SELECT orders_handled FROM continued",
                           [&](std::int64_t orders_handled) { handled = orders_handled; });
  EXPECT_EQ(handled, 7);
}

TEST_F(LogPlaceTest, AnotherRobotsOrAnOldMatchIsNotContinued) {
  record(folder / "match.db", 7, 2 * robot::kLongestPause_s);
  EXPECT_EQ(Reader{place().path}.sessions().at(0).continues_uuid, "");
  record(folder / "match-r1-20260101T000000Z.db", 7);
  context.settings.run.robot_id = 2;
  EXPECT_EQ(Reader{place().path}.sessions().at(0).continues_uuid, "");
}

TEST_F(LogPlaceTest, DamagedAndForeignFilesStopNobody) {
  std::ofstream{folder / "match.db"} << "something else";
  std::ofstream{folder / "match-r1-broken.db"} << std::string(5000, 'x');
  std::filesystem::create_directory(folder / "match-r1-folder.db");
  const auto placed = place();
  EXPECT_EQ(Reader{placed.path}.sessions().at(0).continues_uuid, "");
  EXPECT_TRUE(log_lines->wait_for("is passed over"));
}

TEST_F(LogPlaceTest, AFolderThatRefusesIsReplacedByTheTemporaryOne) {
  context.settings.recorder.log = folder / "nowhere/match.db";
  const auto placed = place();
  EXPECT_EQ(placed.path.parent_path(), std::filesystem::temp_directory_path());
  EXPECT_TRUE(log_lines->wait_for("nowhere/match.db"));
  placed.writer->finalise();
  std::filesystem::remove(placed.path);
}

TEST_F(LogPlaceTest, AServicesFolderThatRefusesIsReplacedByItsStateFolder) {
  std::filesystem::create_directory(folder / "state");
  setenv("STATE_DIRECTORY", ((folder / "none").string() + ":" + (folder / "state").string()).c_str(), 1);
  context.settings.recorder.log = folder / "nowhere/match.db";
  const auto placed = place();
  unsetenv("STATE_DIRECTORY");
  EXPECT_EQ(placed.path.parent_path(), folder / "state");
}

TEST_F(LogPlaceTest, AFolderIsFilledWithNamesOfTeamRobotAndTime) {
  context.settings.recorder.log = (folder / "any").parent_path();
  context.settings.run.team = "cambada";
  const auto first = place();
  EXPECT_THAT(first.path.filename().string(), testing::MatchesRegex("cambada-1-[0-9]+T[0-9]+Z\\.db"));
  EXPECT_EQ(first.path.parent_path(), (folder / "any").parent_path());
  const auto second = place();
  EXPECT_NE(second.path, first.path);
  EXPECT_EQ(Reader{second.path}.sessions().at(0).continues_uuid, Reader{first.path}.sessions().at(0).uuid);
}

TEST_F(LogPlaceTest, AFileInTheFoldersPlaceStopsNobody) {
  std::ofstream{folder / "logs"} << "no folder";
  context.settings.recorder.log = folder / "logs/{team}-{robot}.db";
  const auto placed = place();
  EXPECT_TRUE(log_lines->wait_for("logs/team-1.db"));
  placed.writer->finalise();
  EXPECT_EQ(Reader{placed.path}.sessions().size(), 1u);
  std::filesystem::remove(placed.path);
}

TEST_F(LogPlaceTest, InLockstepAFileThatExistsIsRefused) {
  record(folder / "match.db", 1);
  context.settings.run.lockstep = true;
  EXPECT_THROW(place(), std::runtime_error);
}

}  // namespace
}  // namespace trivela::nodes
