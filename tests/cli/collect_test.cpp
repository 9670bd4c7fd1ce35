// Logs fetched by a real rsync, over a stand-in for ssh that runs the host's command here.
#include <gmock/gmock.h>

#include <chrono>
#include <fstream>
#include <iterator>

#include "cli/collect/fetch.hpp"
#include "cli/verbs.hpp"
#include "tests/cli/verb_run.hpp"
#include "tests/evaluator/match_fixture.hpp"

namespace trivela::cli {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Collect : public evaluator::LogTest {
 protected:
  Collect() : robot{"team@robot3", path("robot")} {
    fs::create_directory(path("robot"));
    std::ofstream script(path("ssh"));
    script << "#!/bin/sh\nwhile [ \"$1\" = -o ] || [ \"$1\" = -l ]; do shift 2; done\n[ \"$1\" = nobody ] && { echo no "
              "route >&2; exit 255; }\n"
              "shift\nexec sh -c \"$*\"\n";
    script.close();
    fs::permissions(path("ssh"), fs::perms::owner_all);
  }

  fs::path record(const std::string& name, int kicks) {
    evaluator::MatchLog match(path("robot") / name, session(), options());
    match.kicks(1, "on_target", kicks);
    match.close();
    return path("robot") / name;
  }

  Fetched fetched(const LogHost& host) { return fetch_logs(host, path("here"), path("ssh")); }
  Fetched fetched() { return fetched(robot); }

  static std::string bytes_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  LogHost robot;
};

TEST_F(Collect, FetchesFinishedLogsAndLeavesTheRobotsAsTheyAre) {
  const fs::path log = record("team-3-20261122T100000Z.db", 3);
  const std::string before = bytes_of(log);
  std::ofstream(path("robot") / "notes.txt") << "no log";
  const Fetched first = fetched();
  EXPECT_EQ(first.logs, 1);
  EXPECT_EQ(first.here, 1);
  EXPECT_THAT(first.missing, IsEmpty());
  EXPECT_TRUE(bytes_of(path("here") / "robot3" / log.filename()) == before);
  EXPECT_TRUE(bytes_of(log) == before);
  EXPECT_FALSE(fs::exists(path("here") / "robot3" / "notes.txt"));
  EXPECT_EQ(fetched().here, 1) << "once more";
}

TEST_F(Collect, LeavesALogAloneThatIsBeingWritten) {
  record("done.db", 1);
  evaluator::MatchLog match(path("robot") / "now.db", session(), options());
  match.kicks(1, "on_target", 1);
  match.writer().flush();
  const Fetched during = fetched();
  EXPECT_THAT(during.being_written, ElementsAre("now.db"));
  EXPECT_EQ(during.here, 1);
  EXPECT_FALSE(fs::exists(path("here") / "robot3" / "now.db"));
  match.close();
  EXPECT_EQ(fetched().here, 2);
}

TEST_F(Collect, GoesOnWithALogThatCameInPart) {
  const fs::path log = record("half.db", 200);
  fetched();
  const fs::path here = path("here") / "robot3" / "half.db";
  fs::resize_file(here, fs::file_size(here) / 2);
  EXPECT_EQ(fetched().here, 1);
  EXPECT_TRUE(bytes_of(here) == bytes_of(log));
}

TEST_F(Collect, ALogThatIsDamagedThereIsSaid) {
  const fs::path log = record("hurt.db", 200);
  fs::resize_file(log, fs::file_size(log) / 2);
  const Fetched result = fetched();
  EXPECT_EQ(result.here, 0);
  EXPECT_THAT(result.missing, ElementsAre(AllOf(HasSubstr("hurt.db"), HasSubstr("malformed"))));
}

TEST_F(Collect, ARobotThatIsNotThereIsSaid) {
  EXPECT_THAT(fetched({"nobody", "logs"}).missing, ElementsAre(HasSubstr("no route")));
  EXPECT_THAT(fetched({"robot4", path("empty")}).missing, ElementsAre(HasSubstr("No such file")));
  EXPECT_THAT(fetched().missing, ElementsAre(HasSubstr("there is no log in")));
}

TEST_F(Collect, ATeamsFileStandsForItsRobots) {
  record("team-3-20261122T100000Z.db", 2);
  std::ofstream(path("team.toml")) << "[team]\nname = \"t\"\nnumber = 39\nnetwork = \"172.16.39.0/24\"\n"
                                      "group = \"224.16.32.39\"\nlogs = \""
                                   << path("robot").string()
                                   << "\"\n[domains]\nrobot = 60\nteam = 61\n[[robot]]\nnumber = 3\n"
                                   << "address = \"172.16.39.3\"\nrobot = \"" TRIVELA_SOURCE_DIR
                                      "/config/robots/cambada_1.toml\"\n[base]\naddress = \"172.16.39.9\"\n";
  const VerbRun run =
      run_verbs({add_collect}, {"collect", path("team.toml"), "--to", path("here"), "--ssh", path("ssh")});
  EXPECT_THAT(run.out, AllOf(HasSubstr("172.16.39.3"), HasSubstr("missing: nothing")));
  EXPECT_EQ(run.exit_code, kDone);
  EXPECT_TRUE(fs::exists(path("here") / "172.16.39.3" / "team-3-20261122T100000Z.db"));
}

TEST(LogHosts, AreReadOrRefused) {
  EXPECT_EQ(log_host("robot3", "logs").path, "logs");
  EXPECT_EQ(log_host("me@robot3:/var/lib/trivela", "logs").host, "me@robot3");
  EXPECT_EQ(log_host("me@robot3:/var/lib/trivela", "logs").path, "/var/lib/trivela");
  for (const char* const wrong : {"-oProxyCommand=x", "me@-o", ":logs", "robot3:", "a/b:c"})
    EXPECT_THROW(log_host(wrong, "logs"), UsageError) << wrong;
}

TEST(Programs, AreMissedByName) {
  EXPECT_NO_THROW(require_program("sh", "never"));
  EXPECT_THROW(require_program("no-such-program", "apt-get install it"), std::runtime_error);
}

TEST_F(Collect, EndsWithWhatIsMissingAndItsExitCode) {
  record("done.db", 2);
  evaluator::MatchLog match(path("robot") / "now.db", session(), options());
  match.kicks(1, "on_target", 1);
  match.writer().flush();
  const VerbRun run = run_verbs({add_collect}, {"collect", "team@robot3", "nobody:logs", "--path", path("robot"),
                                                "--to", path("here"), "--ssh", path("ssh")});
  EXPECT_EQ(run.exit_code, kDoneWithLoss);
  EXPECT_THAT(run.out,
              AllOf(HasSubstr("\nmissing:\n"),
                    HasSubstr("  team@robot3: now.db is being written; collect again when its recorder has ended\n"),
                    HasSubstr("  nobody: its logs in logs: no route\n")));
  EXPECT_TRUE(fs::exists(path("here") / "robot3" / "done.db")) << "what can be fetched is fetched";
}

TEST_F(Collect, ALogWhoseRecorderDiedComesWithItsWriteAheadLog) {
  {
    evaluator::MatchLog match(path("open.db"), session(), options());
    match.kicks(1, "on_target", 3);
    match.writer().flush();
    for (const char* const suffix : {"", "-wal"})
      fs::copy_file(path(std::string("open.db") + suffix), path("robot") / (std::string("dead.db") + suffix));
  }
  const fs::path wal = path("robot") / "dead.db-wal", here = path("here") / "robot3";
  ASSERT_GT(fs::file_size(wal), 0u);
  EXPECT_THAT(fetched().being_written, ElementsAre("dead.db")) << "it changed a moment ago";
  fs::last_write_time(wal, fs::file_time_type::clock::now() - std::chrono::minutes(2));
  EXPECT_EQ(fetched().here, 1);
  EXPECT_TRUE(fs::exists(here / "dead.db-wal"));
  EXPECT_EQ(rows_of(log::Reader(here / "dead.db"), "kick_orders"), 3);
}

TEST_F(Collect, AWriteAheadLogOfBeforeIsNotReadIntoTheLogAsItIsNow) {
  record("match.db", 2);
  const fs::path here = path("here") / "robot3";
  fs::create_directories(here);
  for (const char* const suffix : {"match.db-wal", "match.db-shm"}) std::ofstream(here / suffix) << "of another time";
  EXPECT_EQ(fetched().here, 1);
  EXPECT_FALSE(fs::exists(here / "match.db-wal"));
  EXPECT_FALSE(fs::exists(here / "match.db-shm"));
}

TEST_F(Collect, AnEmptyFileIsNoLogAndNamesWithBlanksComeAsTheyAre) {
  record("semi final's.db", 2);
  std::ofstream(path("robot") / "begun.db").close();
  const Fetched all = fetched();
  EXPECT_EQ(all.logs, 1);
  EXPECT_EQ(all.here, 1);
  EXPECT_THAT(all.missing, IsEmpty());
  EXPECT_TRUE(fs::exists(path("here") / "robot3" / "semi final's.db"));
}

TEST(LogHosts, APathThatLooksLikeAFlagIsAPath) {
  EXPECT_EQ(log_host("robot3:-name", "logs").path, "./-name");
  EXPECT_EQ(log_host("robot3", "-name").path, "./-name");
}

}  // namespace
}  // namespace trivela::cli
