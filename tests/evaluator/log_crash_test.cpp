#include <gmock/gmock.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include "tests/evaluator/child.hpp"
#include "tests/evaluator/log_fixture.hpp"

namespace trivela::evaluator {
namespace {

using log::Reader;
using log::Value;
using log::Writer;

using LogCrash = LogTest;

TEST_F(LogCrash, AKilledRecorderLeavesWholeRowsAndMissesAtMostTheLastGroup) {
  constexpr std::int64_t kGroup = 50;
  const Child child([&](const auto& report) {
    Writer writer(path(), session(), options(65536, 0.001));
    const auto referee = referee_table(writer);
    const auto drive = drive_table(writer);
    for (std::int64_t seq = 0;; ++seq) {
      writer.push(referee, referee_row(seq));
      writer.push(drive, drive_row(seq, 1.0));
      if (seq % kGroup != kGroup - 1) continue;
      writer.flush();
      report(seq + 1);  // so many are safe
    }
  });
  std::int64_t safe = 0;
  while (safe < 20 * kGroup) {
    safe = child.next();
    ASSERT_GT(safe, 0);
  }
  ::kill(child.id, SIGKILL);
  int status = 0;
  ::waitpid(child.id, &status, 0);
  for (std::int64_t more = child.next(); more > 0; more = child.next()) safe = more;

  const Reader reader(path());
  std::int64_t next = 0;
  reader.query("SELECT seq FROM referee ORDER BY session_id, robot_id, seq",
               [&](std::int64_t seq) { EXPECT_EQ(seq, next++); });
  EXPECT_GE(next, safe);
  EXPECT_LE(next, safe + kGroup);
  EXPECT_LE(std::abs(rows_of(reader, "drive_commands") - next), 1) << "rows of one instant may lie in two groups";
  ASSERT_EQ(reader.warnings().size(), 1u);
  EXPECT_THAT(reader.warnings()[0], testing::HasSubstr("was not closed"));
}

TEST_F(LogCrash, AFullDiskIsReportedAndWhatWasWrittenIsKept) {
  const Child child([&](const auto& report) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{512 * 1024, 512 * 1024};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    Writer writer(path(), session(), options(65536, 60.0));  // each group is as large as its flush makes it
    const auto drive = drive_table(writer);
    std::int64_t safe = 0;
    try {
      for (std::int64_t seq = 0; seq < 1000000; ++seq) {
        writer.push(drive, drive_row(seq, 1.0));
        if (seq % 100 != 99) continue;
        writer.flush();
        safe = seq + 1;
      }
    } catch (const std::runtime_error&) {
      report(safe);
    }
    report(writer.health().has_value() ? 1 : 0);
    try {
      writer.finalise();
      report(0);
    } catch (const std::runtime_error& error) {
      report(std::string(error.what()).find("100 rows are missing") != std::string::npos ? 1 : 2);
    }
  });
  const std::int64_t safe = child.next();
  EXPECT_GT(safe, 0);
  EXPECT_EQ(child.next(), 1) << "health";
  EXPECT_EQ(child.next(), 1) << "finalise throws, with the number of missing rows";
  int status = 0;
  ::waitpid(child.id, &status, 0);
  EXPECT_EQ(status, 0);

  const Reader reader(path());
  EXPECT_EQ(rows_of(reader, "drive_commands"), safe);
  EXPECT_FALSE(reader.warnings().empty());
}

}  // namespace
}  // namespace trivela::evaluator
