// A recorder that is killed in mid match loses nothing that it had committed, and of the rest no more than waits for
// the disk: in lockstep the match goes on when half the queue is free.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <cstdint>

#include "bus/domain/domain.hpp"
#include "bus/reader.hpp"
#include "config/settings.hpp"
#include "idl/messages.hpp"
#include "tests/e2e/log_rows.hpp"
#include "tests/e2e/running_match.hpp"

namespace trivela::e2e {
namespace {

using Clock = std::chrono::steady_clock;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Another listener of the match, who counts the drive commands.
class Witness {
 public:
  explicit Witness(const config::Domain& domain)
      : participant_(bus::loopback(domain.domain_id, domain.tag)), reader_(participant_, {.keep_all = true}) {}

  /// Listens until `met`; false if that does not happen.
  template <class Condition>
  bool hears_until(const Condition& met) {
    const auto deadline = Clock::now() + kTimeout;
    while (!met() && Clock::now() < deadline) {
      reader_.wait(std::chrono::milliseconds{20});
      take();
    }
    return met();
  }

  /// Notes what has come meanwhile.
  void take() {
    reader_.take(
        [&](const msg::DriveCommand& command) { last_ = std::max(last_, static_cast<std::int64_t>(command.seq)); });
  }

  /// The last command that has come; 0: none.
  std::int64_t last() const { return last_; }

 private:
  bus::Participant participant_;
  bus::Reader<msg::DriveCommand> reader_;
  std::int64_t last_ = 0;
};

std::int64_t last_command_in(const Reader& log) { return number_of(log, "SELECT max(seq) FROM drive_commands"); }

TEST(RecorderCrash, AKilledRecorderLeavesAWholeLogWithAllThatItHadCommitted) {
  constexpr std::int64_t kQueue = 2000;  // rows; a cycle has four at least: odometry, belief, command, kicker
  RunningMatch match{{"--set", fmt::format("recorder.queue_capacity={}", kQueue)}};
  Witness witness{config::load_settings(match.config()).domain};
  ASSERT_TRUE(witness.hears_until([&] { return witness.last() >= 3000; })) << match.program().errors();
  // While the match goes on, what was heard is committed group by group.
  const std::int64_t received = witness.last();
  std::int64_t committed = 0;
  {
    const Reader growing{match.log()};
    ASSERT_TRUE(witness.hears_until([&] { return (committed = last_command_in(growing)) >= received; }))
        << committed << " of " << received << " commands are in the log";
  }
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
  const std::int64_t last = last_command_in(log);
  EXPECT_GE(last, committed);
  EXPECT_GE(last, witness.last() - kQueue / 4);
  // The recorder takes part in every cycle, so that none was finished without it.
  EXPECT_LE(last, witness.last());
  // All streams end together, give or take the cycle in which the group was closed.
  for (const char* const stream : {"odometry", "world_states", "kicker_status", "referee"}) {
    EXPECT_NEAR(static_cast<double>(number_of(log, fmt::format("SELECT max(seq) FROM {}", stream))),
                static_cast<double>(last), 2)
        << stream;
  }
  fmt::print("{} commands were heard until the end of the match, {} are in the log\n", witness.last(), last);

  // The report reads it, and says that something may be missing.
  Program report{"trivela", {"report", "match.db"}, match.folder().path()};
  EXPECT_EQ(report.wait(), 3);
}

}  // namespace
}  // namespace trivela::e2e
