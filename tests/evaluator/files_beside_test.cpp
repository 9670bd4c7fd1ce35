// What lies beside a log as its -wal: its own, another recording's or an older copy; and what reading leaves behind.
#include "log/file/files_beside.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <iterator>
#include <set>
#include <string_view>
#include <thread>

#include "evaluator/sessions/log_findings.hpp"
#include "log/file/log_file.hpp"
#include "log/merge/merge.hpp"
#include "log/read/reader.hpp"
#include "log/write/additions.hpp"
#include "tests/evaluator/experiment_fixture.hpp"
#include "tests/evaluator/match_fixture.hpp"

namespace trivela::evaluator {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr unsigned kNobody = 65534;

class FilesBeside : public LogTest {
 protected:
  /// A closed log with three kicks.
  fs::path closed(const std::string& name) {
    MatchLog match(path(name), session(), options());
    match.kicks(1, "on_target", 3);
    match.close();
    return path(name);
  }

  /// Copies of what a recorder has written that goes on: the log and, if wanted, its -wal under another log's name.
  void copy_of_open(const std::string& log, const std::string& wal, int kicks = 5) {
    MatchLog match(path("open.db"), session(), options());
    match.kicks(1, "on_target", kicks);
    match.writer().flush();
    if (!log.empty()) fs::copy_file(path("open.db"), path(log));
    if (!wal.empty()) fs::copy_file(path("open.db-wal"), path(wal));
    match.close();
    fs::remove(path("open.db"));
  }

  static std::int64_t kicks_in(const fs::path& log) {
    std::int64_t kicks = 0;
    log::Reader(log).query("SELECT count(*) FROM kick_orders", [&](std::int64_t n) { kicks = n; });
    return kicks;
  }

  static std::string said_of(const fs::path& log) {
    std::string said;
    for (const LogFinding& found : examine_log(log)) {
      if (found.health != Health::kOk) said += found.check + ": " + found.value + "; " + found.advice + "\n";
    }
    return said;
  }

  std::set<std::string> files() {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(path("").parent_path())) names.insert(entry.path().filename());
    return names;
  }
};

TEST_F(FilesBeside, AClosedLogKeepsItsRowsBesideTheWalOfAnother) {
  closed("whole.db");
  copy_of_open("", "whole.db-wal");
  EXPECT_EQ(kicks_in(path("whole.db")), 3);
  EXPECT_THAT(said_of(path("whole.db")), AllOf(HasSubstr("whole.db-wal is of another recording"),
                                               HasSubstr("move whole.db-wal away"), Not(HasSubstr("damaged"))));
  log::merge({path("whole.db")}, path("merged.db"));
  EXPECT_EQ(kicks_in(path("merged.db")), 3);
}

TEST_F(FilesBeside, AnUnclosedLogKeepsItsRowsBesideTheWalOfAnother) {
  copy_of_open("first.db", "first.db-wal", 3);
  log::merge({path("first.db")}, path("unclosed.db"));
  ASSERT_EQ(kicks_in(path("unclosed.db")), 3);
  SQLite::Database(path("unclosed.db").string(), SQLite::OPEN_READWRITE).exec("PRAGMA journal_mode = WAL");
  copy_of_open("", "unclosed.db-wal");
  EXPECT_EQ(kicks_in(path("unclosed.db")), 3);
  EXPECT_THAT(said_of(path("unclosed.db")), HasSubstr("unclosed.db-wal is of another recording"));
}

TEST_F(FilesBeside, NothingIsWrittenToALogBesideTheWalOfAnother) {
  closed("whole.db");
  copy_of_open("", "whole.db-wal");
  try {
    const log::Additions additions(path("whole.db"));
    ADD_FAILURE() << "SQLite would have written the other's rows into it";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("whole.db-wal is not of"));
  }
  EXPECT_EQ(kicks_in(path("whole.db")), 3);
}

TEST_F(FilesBeside, ADeviceIsThereButNoLog) {
  try {
    const log::Reader reader("/dev/null");
    ADD_FAILURE();
  } catch (const log::NoSuchLog& error) {
    EXPECT_STREQ(error.what(), "/dev/null is a pipe or a device, no match log");
  }
}

TEST_F(FilesBeside, ReadingLeavesNothingAndSaysTheSameTwice) {
  copy_of_open("alone.db", "");
  copy_of_open("both.db", "both.db-wal");
  const auto before = files();
  const std::string said = said_of(path("alone.db"));
  EXPECT_THAT(said, AllOf(HasSubstr("no -wal lies beside it"), Not(HasSubstr("-wal of"))));
  EXPECT_EQ(said_of(path("alone.db")), said);
  EXPECT_EQ(kicks_in(path("both.db")), 5);
  EXPECT_EQ(files(), before);
}

TEST_F(FilesBeside, AReaderHasEverySessionThatWasCommittedWhenItBegan) {
  constexpr int kMatches = 1 << 20;
  constexpr int kReadings = 200, kMatchesARun = 7, kMatchesAReading = 4;
  std::atomic<int> committed = 0, readings = 0;
  std::atomic<bool> ends = false;
  auto writes = std::make_unique<TestExperiment>(path("live.db"), kMatches);
  std::jthread writer([&] {
    while (!ends) {  // commits, ends so that its -wal goes, and goes on in another
      for (int match = 0; match < kMatchesARun && !ends; ++match) {
        for (int now = readings; committed >= kMatchesAReading * (now + 1); now = readings) readings.wait(now);
        writes->begin();
        writes->session(static_cast<std::uint32_t>(committed.load()), 0, "stopped", {{1, "stopped"}});
        writes->possession(1, 1, "stopped", 1.0, kIn);
        writes->commit();
        ++committed;
      }
      writes->finish();
      writes.reset();
      writes = std::make_unique<TestExperiment>(path("live.db"), kMatches);
    }
  });
  while (readings < kReadings && !HasFailure()) {
    const int at_least = committed;
    try {
      const log::Reader reader(path("live.db"));
      EXPECT_GE(reader.sessions().size(), static_cast<std::size_t>(at_least));
      EXPECT_NE(reader.wal(), log::Wal::kOfAnother);
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what();
    }
    ++readings;
    readings.notify_one();
  }
  ends = true;
  readings = kMatches;
  readings.notify_one();
}

TEST_F(FilesBeside, AnUnclosedLogIsReadWhereNothingCanBeWritten) {
  copy_of_open("open_copy.db", "open_copy.db-wal");
  const fs::path folder = path("").parent_path();
  fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read |
                              fs::perms::others_exec | fs::perms::group_read | fs::perms::group_exec);
  for (const char* const name : {"open_copy.db", "open_copy.db-wal"})
    fs::permissions(path(name), fs::perms::owner_read | fs::perms::group_read | fs::perms::others_read);
  EXPECT_EXIT(
      {
        if (::geteuid() == 0 && ::setresuid(kNobody, kNobody, kNobody) != 0) std::_Exit(3);
        std::_Exit(kicks_in(path("open_copy.db")) == 5 ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
  fs::permissions(folder, fs::perms::owner_all);
}

TEST_F(FilesBeside, WhatAKilledReaderCopiedGoesWithTheNextReading) {
  copy_of_open("open_copy.db", "open_copy.db-wal");
  const fs::path temporary = path("tmp");
  fs::create_directory(temporary);
  ::setenv("TMPDIR", temporary.c_str(), 1);
  const auto made_an_hour_ago = [&] {
    for (const auto& entry : fs::directory_iterator(temporary))
      fs::last_write_time(entry.path(), fs::file_time_type::clock::now() - std::chrono::hours(1));
  };
  const auto folders = [&] { return std::distance(fs::directory_iterator(temporary), fs::directory_iterator()); };
  EXPECT_EXIT(
      {
        const log::ReadableLog killed(path("open_copy.db"));
        ::raise(SIGKILL);
      },
      testing::KilledBySignal(SIGKILL), "");
  EXPECT_EQ(folders(), 1);
  { const log::ReadableLog next(path("open_copy.db")); }
  EXPECT_EQ(folders(), 1) << "a young one may be of a program that has not taken its lock yet";
  made_an_hour_ago();
  {
    const log::ReadableLog reads(path("open_copy.db"));
    EXPECT_EQ(folders(), 1) << "its own";
    made_an_hour_ago();
    const log::ReadableLog another(path("open_copy.db"));
    EXPECT_EQ(folders(), 2) << "that of one who still reads stays";
  }
  EXPECT_EQ(folders(), 0);
  ::unsetenv("TMPDIR");
}

TEST_F(FilesBeside, ACopyThatARecorderCrossedIsWholeOrRefused) {
  const std::string log = path("busy.db").string();
  SQLite::Database writer(log, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  writer.exec(  // a copy takes long between the place of `first` and that of `last`
      "PRAGMA journal_mode = WAL; PRAGMA synchronous = OFF; CREATE TABLE first(n);"
      "INSERT INTO first VALUES(0); CREATE TABLE filler(x); INSERT INTO filler VALUES(zeroblob(10000000));"
      "CREATE TABLE last(n); INSERT INTO last VALUES(0)");
  fs::permissions(path("").parent_path(),
                  fs::perms::group_read | fs::perms::group_exec | fs::perms::others_read | fs::perms::others_exec,
                  fs::perm_options::add);
  const pid_t reader = ::fork();
  if (reader == 0) {
    if (::geteuid() == 0 && ::setresuid(kNobody, kNobody, kNobody) != 0) std::_Exit(3);
    int whole = 0, refused = 0;
    while ((whole < 20 || refused == 0) && whole + refused < 300) {
      try {
        const log::ReadableLog copy(log);
        SQLite::Database reads(copy.name(), SQLite::OPEN_READONLY | SQLite::OPEN_URI);
        if (reads.execAndGet("SELECT first.n = last.n FROM first, last").getInt() != 1) std::_Exit(1);
        ++whole;
      } catch (const std::exception& error) {
        if (std::string_view(error.what()).find("ask again") == std::string_view::npos) std::_Exit(2);
        ++refused;
      }
    }
    std::_Exit(whole > 0 ? 0 : 4);
  }
  int status = 0;
  for (int commits = 0; ::waitpid(reader, &status, WNOHANG) == 0; ++commits) {
    constexpr std::array kPages{200, 1000,
                                8000};  // between two new starts of the -wal: 200 leave no time for a copy, 8000 do
    if (commits % 2000 == 0) writer.exec(fmt::format("PRAGMA wal_autocheckpoint = {}", kPages[commits / 2000 % 3]));
    writer.exec("BEGIN; UPDATE first SET n = n + 1; UPDATE last SET n = n + 1; COMMIT");
  }
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0) << "1: half a transaction, 2: another sentence, 4: none was whole";
}

}  // namespace
}  // namespace trivela::evaluator
