// A recorder that is killed in mid match loses no more than its last group of rows.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <vector>

#include "bus/domain.hpp"
#include "bus/messages.hpp"
#include "bus/reader.hpp"
#include "config/settings.hpp"
#include "tests/e2e/log_rows.hpp"
#include "tests/e2e/running_match.hpp"

namespace trivela::e2e {
namespace {

using Clock = std::chrono::steady_clock;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Another listener of the match, who notes when each drive command came.
class Witness {
 public:
  explicit Witness(const config::Domain& domain)
      : participant_(bus::loopback(domain.domain_id, domain.tag)), reader_(participant_, {.keep_all = true}) {}

  /// Listens until `n` commands have come; false if they do not.
  bool hears(std::size_t n) {
    const auto deadline = Clock::now() + kPatience;
    while (commands_.size() < n && Clock::now() < deadline) {
      reader_.wait(std::chrono::milliseconds{100});
      take();
    }
    return commands_.size() >= n;
  }

  /// Notes what has come meanwhile.
  void take() {
    const auto now = Clock::now();
    reader_.take(
        [&](const msg::DriveCommand& command) { commands_.emplace_back(now, static_cast<std::int64_t>(command.seq)); });
  }

  /// The last command that had come at an instant; 0: none.
  std::int64_t last_before(Clock::time_point instant) const {
    std::int64_t last = 0;
    for (const auto& [came, seq] : commands_) {
      if (came <= instant) last = std::max(last, seq);
    }
    return last;
  }

 private:
  bus::Participant participant_;
  bus::Reader<msg::DriveCommand> reader_;
  std::vector<std::pair<Clock::time_point, std::int64_t>> commands_;
};

TEST(RecorderCrash, AKilledRecorderLeavesAWholeLogWithoutItsLastGroupAtMost) {
  // A group is committed 0.1 s after its first row; the rest is for the commit itself on a loaded machine.
  constexpr std::chrono::milliseconds kGroup{100}, kCommit{400};
  RunningMatch match;
  Witness witness{config::load_settings(match.config()).domain};
  ASSERT_TRUE(witness.hears(3000)) << match.program().errors();
  const auto killed = Clock::now();
  kill(match.node("trivela-recorder").id(), SIGKILL);
  EXPECT_EQ(match.program().wait(), 1);
  witness.take();
  EXPECT_THAT(match.program().errors(),
              AllOf(HasSubstr("recorder died"), HasSubstr("match.db"), Not(HasSubstr("did not stop"))));
  EXPECT_THAT(match.nodes_left(std::chrono::milliseconds{0}), IsEmpty());
  EXPECT_THAT(match.folder().files(".toml"), IsEmpty());

  const Reader log{match.log()};
  ASSERT_EQ(log.warnings().size(), 1u);
  EXPECT_THAT(log.warnings()[0], HasSubstr("was not closed"));
  EXPECT_THAT(gaps_of(log), IsEmpty());
  EXPECT_THAT(losses_of(log), IsEmpty());
  const std::int64_t last = number_of(log, "SELECT max(seq) FROM drive_commands");
  EXPECT_GE(last, witness.last_before(killed - kGroup - kCommit));
  // The recorder takes part in every cycle, so that none was finished without it.
  EXPECT_LE(last, witness.last_before(Clock::now()));
  // All streams end together, give or take the cycle in which the group was closed.
  for (const char* const stream : {"odometry", "world_states", "kicker_status", "referee"}) {
    EXPECT_NEAR(static_cast<double>(number_of(log, fmt::format("SELECT max(seq) FROM {}", stream))),
                static_cast<double>(last), 2)
        << stream;
  }
  fmt::print("{} commands were heard until the kill, {} are in the log\n", witness.last_before(killed), last);

  // The report reads it, and says that something may be missing.
  Program report{"trivela", {"report", "match.db"}, match.folder().path()};
  EXPECT_EQ(report.wait(), 3);
}

}  // namespace
}  // namespace trivela::e2e
