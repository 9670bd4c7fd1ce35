// What a recorder that is killed in real time loses, by the word of a second listener with a clock of its own.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <poll.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <optional>
#include <random>
#include <vector>

#include "bus/domain/domain.hpp"
#include "bus/reader.hpp"
#include "bus/writer.hpp"
#include "config/settings.hpp"
#include "idl/messages.hpp"
#include "tests/e2e/log_rows.hpp"
#include "tests/e2e/program.hpp"
#include "tests/support/folder.hpp"

namespace trivela::e2e {
namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;
using testing::HasSubstr;

constexpr Milliseconds kSpan{100};  // recorder.group_commit_s
constexpr int kKills = 8;

config::Settings settings_for(const tests::Folder& folder, int kill) {
  config::Settings settings = config::load_settings(std::filesystem::path{TRIVELA_SOURCE_DIR} / "config/default.toml");
  std::random_device random;
  settings.run.lockstep = false;
  settings.domain.domain_id = 1 + random() % 100;
  settings.domain.tag = fmt::format("loss-{}-{:08x}-{}", getpid(), random(), kill);
  settings.recorder.log = folder / "match.db";
  settings.recorder.group_commit_s = kSpan.count() / 1000.0;
  return settings;
}

/// A robot that sends a command each millisecond, and who notes when each was on the wire.
class Wire {
 public:
  explicit Wire(const config::Domain& domain)
      : sender_(bus::loopback(domain.domain_id, domain.tag)),
        witness_(bus::loopback(domain.domain_id, domain.tag)),
        writer_(sender_),
        reader_(witness_, {.keep_all = true}) {}

  /// The recorder listens and the witness does.
  bool complete() { return writer_.wait_for_readers(2, kTimeout) && reader_.wait_for_writers(1, kTimeout); }

  void play_until(Clock::time_point end) {
    for (auto before = Clock::now(); before < end;) {
      writer_.write({.robot_id = 1,
                     .seq = ++sent_,
                     .t_ns = static_cast<std::int64_t>(sent_),
                     .vx_mps = 0.0,
                     .vy_mps = 0.0,
                     .omega_radps = 0.0,
                     .lever_kind = 0});
      reader_.wait(std::chrono::milliseconds{1});
      poll(nullptr, 0, 1);  // the pace
      note();
      const auto now = Clock::now();
      longest_ = std::max<Milliseconds>(longest_, now - before);
      before = now;
    }
  }

  /// Notes what has come meanwhile.
  void note() {
    reader_.take([&](const msg::DriveCommand& command) { received_.resize(command.seq, Clock::now()); });
  }

  /// When command `seq` was heard; none: never.
  std::optional<Clock::time_point> received(std::uint64_t seq) const {
    return seq >= 1 && seq <= received_.size() ? std::optional{received_[seq - 1]} : std::nullopt;
  }

  /// The longest that the machine kept this thread from what it does each two milliseconds.
  Milliseconds longest() const { return longest_; }

 private:
  bus::Participant sender_, witness_;
  bus::Writer<msg::DriveCommand> writer_;
  bus::Reader<msg::DriveCommand> reader_;
  std::uint64_t sent_ = 0;
  std::vector<Clock::time_point> received_;  // command by command
  Milliseconds longest_{0};
};

struct Loss {
  Milliseconds age{0};      // at the kill, of the oldest command that was heard and is not in the log
  Milliseconds stalled{0};  // the longest that the machine kept the witness waiting
};

/// Kills a recorder at a seeded moment of its work on a disk whose synchronisations take `disk_ms` longer.
Loss loss_of_a_kill(int kill, int disk_ms) {
  std::mt19937 random{static_cast<unsigned>(1000 * disk_ms + kill)};
  const tests::Folder folder;
  const config::Settings settings = settings_for(folder, kill);
  std::ofstream{folder / "nodes.toml"} << config::to_toml_text(settings);
  Program recorder{"trivela-recorder", {"--config", "nodes.toml"}, folder.path(), [&] {
                     setenv("LD_PRELOAD", TRIVELA_SLOW_DISK, 1);
                     setenv("SLOW_DISK_MS", std::to_string(disk_ms).c_str(), 1);
                   }};
  Wire wire{settings.domain};
  if (!wire.complete()) throw std::runtime_error{"the recorder does not come: " + recorder.errors()};
  wire.play_until(Clock::now() + std::chrono::milliseconds{900 + random() % 200});
  const auto killed = Clock::now();
  recorder.signal(SIGKILL);
  recorder.wait();
  wire.note();
  const Reader log{folder / "match.db"};
  // Rows are committed in the order in which they came; what a busy machine's bus replaced before is a counted gap.
  const std::int64_t last = number_of(log, "SELECT coalesce(max(seq), 0) FROM drive_commands");
  EXPECT_GT(last, 0) << "nothing was recorded";
  const auto first_missing = wire.received(static_cast<std::uint64_t>(last) + 1);
  return {first_missing && *first_missing < killed ? Milliseconds{killed - *first_missing} : Milliseconds{0},
          wire.longest()};
}

class RecorderLoss : public testing::TestWithParam<int> {};

TEST_P(RecorderLoss, AKillLosesNoRowThatIsOlderThanTheSpan) {
  Milliseconds worst{0};
  for (int kill = 0; kill < kKills; ++kill) {
    const Loss loss = loss_of_a_kill(kill, GetParam());
    // What the machine keeps from the witness for so long, it may keep from the recorder's two threads as well.
    EXPECT_LE(loss.age, kSpan + 2 * loss.stalled) << "stalled for " << loss.stalled.count() << " ms";
    worst = std::max(worst, loss.age);
    fmt::print("kill {}: {:.1f} ms lost, the witness waited up to {:.1f} ms\n", kill, loss.age.count(),
               loss.stalled.count());
  }
  fmt::print("disk {} ms slower: at most {:.1f} ms lost in {} kills\n", GetParam(), worst.count(), kKills);
}

INSTANTIATE_TEST_SUITE_P(Disk, RecorderLoss, testing::Values(0, 20, 45),
                         [](const auto& test) { return fmt::format("{}msSlower", test.param); });

TEST(RecorderLossWarning, ADiskThatIsSlowerThanTheSpanIsSaid) {
  const tests::Folder folder;
  const config::Settings settings = settings_for(folder, 0);
  std::ofstream{folder / "nodes.toml"} << config::to_toml_text(settings);
  Program recorder{"trivela-recorder", {"--config", "nodes.toml"}, folder.path(), [] {
                     setenv("LD_PRELOAD", TRIVELA_SLOW_DISK, 1);
                     setenv("SLOW_DISK_MS", "150", 1);
                   }};
  Wire wire{settings.domain};
  ASSERT_TRUE(wire.complete()) << recorder.errors();
  wire.play_until(Clock::now() + std::chrono::seconds{2});
  recorder.signal(SIGTERM);
  EXPECT_EQ(recorder.wait(), 0) << recorder.errors();
  const std::string said = recorder.errors();
  EXPECT_THAT(said, HasSubstr("s for the disk, 0.1 s are allowed"));
  const auto first = said.find("rows waited up to");
  EXPECT_EQ(said.find("rows waited up to", first + 1), std::string::npos) << "said more than once in ten seconds";
}

}  // namespace
}  // namespace trivela::e2e
