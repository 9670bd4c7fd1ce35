#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>

#include "tests/evaluator/child.hpp"
#include "tests/evaluator/scan_fixture.hpp"

namespace trivela::evaluator {
namespace {

using ScanCrash = ScanTest;

TEST_F(ScanCrash, AKilledRecorderLeavesWholeScansAndMissesAtMostTheLastGroup) {
  constexpr std::int64_t kGroup = 50;
  const Child child([&](const auto& report) {
    log::ScanWriter writer(path("scans.db"), scan_session(), options(65536, 0.001));
    for (std::int64_t n = 0;; ++n) {
      writer.push(scan(n));
      if (n % kGroup != kGroup - 1) continue;
      writer.flush();
      report(n + 1);  // so many are safe
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

  const log::ScanReader reader(path("scans.db"));
  const auto size = static_cast<std::int64_t>(reader.size());
  EXPECT_GE(size, safe);
  EXPECT_LE(size, safe + kGroup);
  for (std::int64_t n = 0; n < size; ++n) {
    const kicking::lob::Scan read = reader.scan(static_cast<std::size_t>(n));
    EXPECT_EQ(read.t_ns, scan(n).t_ns);
    EXPECT_EQ(read.range_mm, scan(n).range_mm);
  }
  ASSERT_EQ(reader.warnings().size(), 1u);
  EXPECT_THAT(reader.warnings()[0], testing::HasSubstr("was not closed"));
}

}  // namespace
}  // namespace trivela::evaluator
