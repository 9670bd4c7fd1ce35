// The node refbox and the kicker's driver, as their own processes, with an emulated referee box at the node's TCP link
// while the link and the node are troubled, and somebody orders all the time. What the bus hears of the referee, the
// board's record of its pulses and the recorder's log are the witnesses. By hand, longer: TRIVELA_DEVICE_FAULTS=1000
// and TRIVELA_DEVICE_SEED.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <array>

#include "bus/reader.hpp"
#include "emulators/refbox/emulated_box.hpp"
#include "tests/faults/kicker_rig.hpp"

namespace trivela::faults {
namespace {

using hal::refbox::BoxCommand;
using hal::refbox::BoxFault;
using hal::refbox::CommandKind;
using testing::IsEmpty;

enum class LinkTrouble { kClose, kReset, kDeaf, kFlood, kKill, kStop, kRestart };
constexpr std::array kLinkTroubles{LinkTrouble::kClose, LinkTrouble::kReset, LinkTrouble::kDeaf,   LinkTrouble::kFlood,
                                   LinkTrouble::kKill,  LinkTrouble::kStop,  LinkTrouble::kRestart};
constexpr std::array kLinkTroubleNames{"close", "reset", "deaf", "flood", "kill", "stop", "restart"};

class RefboxCampaign : public testing::Test {
 protected:
  static constexpr std::int64_t kStopped_ns = 500 * kMs;  // from the loss of the box to the word "stopped"

  RefboxCampaign() {
    start();
    EXPECT_TRUE(box_.wait_for_teams(1, std::chrono::seconds{20})) << refbox_->errors();
  }

  /// An object of ours is longer than what a deaf box's kernel has room for: the first one shows the deafness.
  static config::Settings settings_for(const hal::refbox::EmulatedBox& box) {
    config::Settings settings = settings_of_campaign();
    settings.refbox.port = box.port();
    settings.refbox.group = "224.16.32.39";
    settings.refbox.intention = std::string(20'000, 'x');
    return settings;
  }
  void start() {
    refbox_.emplace("trivela-refbox", std::vector<std::string>{"--config", "nodes.toml"}, rig_.folder().path());
  }

  /// Lets the match go on; false: `done` does not come within the time.
  bool play(
      std::int64_t for_ns, const std::function<bool()>& done = [] { return false; }) {
    bool met = false;
    rig_.play(steady_now_ns() + for_ns, [&] {
      words_.take([&](const msg::Referee& word) {
        playing_ = word.playing;
        commands_ = word.command_counter;
        if (!word.playing && word.t_ns > since_ns_ && stopped_ns_ == 0) stopped_ns_ = word.t_ns;
      });
      return met = met || done();
    });
    return met;
  }

  void say(CommandKind kind) { box_.act(BoxCommand{.kind = kind, .team = {}}); }

  bool starts() {
    rig_.note_word(steady_now_ns(), true);
    say(CommandKind::kStart);
    return play(kRecovery_ns, [this] { return playing_; }) && rig_.fires();
  }

  /// From now on a word "stopped" is waited for.
  void lose() {
    since_ns_ = steady_now_ns();
    stopped_ns_ = 0;
  }
  /// The box, or its words, are lost; the bus hears "stopped" within half a second.
  void lose_the_box(LinkTrouble what) {
    lose();
    if (what == LinkTrouble::kClose) box_.act(BoxFault::kClose);
    if (what == LinkTrouble::kReset) box_.act(BoxFault::kReset);
    if (what == LinkTrouble::kDeaf) box_.act(BoxFault::kDeaf);
    if (what == LinkTrouble::kFlood) flood();
    // A deaf box shows with the next object alone.
    const std::int64_t object_ns = what == LinkTrouble::kDeaf ? 80 * kMs : 0;
    const std::int64_t within_ns = kStopped_ns + object_ns + kBusy_ns;
    EXPECT_TRUE(play(2 * kRecovery_ns, [this] { return stopped_ns_ != 0; })) << refbox_->errors();
    EXPECT_LE((stopped_ns_ - since_ns_) / kMs, within_ns / kMs);
    rig_.note_word(stopped_ns_, false);
    if (what == LinkTrouble::kDeaf) box_.act(BoxFault::kHeal);
    if (what == LinkTrouble::kFlood) return;
    const std::uint64_t before = commands_;
    EXPECT_TRUE(play(kRecovery_ns, [&] { return commands_ > before; })) << "it says WELCOME once more";
  }

  /// What nobody knows, as fast as the link carries it, and a STOP in its middle.
  void flood() {
    constexpr int kObjects = 2000;
    std::string noise;
    for (int i = 0; i < 20; ++i) noise += std::string{R"({"command":"DANCE","targetTeam":""})"} + '\0';
    for (int i = 0; i < kObjects / 20; ++i) {
      if (i == kObjects / 40) {
        since_ns_ = steady_now_ns();
        say(CommandKind::kStop);
      }
      box_.send(noise);
    }
  }

  /// The node is gone or stands still: its silence stops the game within run.referee_timeout_s.
  void lose_the_node(LinkTrouble what) {
    lose();
    refbox_->signal(what == LinkTrouble::kKill ? SIGKILL : what == LinkTrouble::kStop ? SIGSTOP : SIGTERM);
    if (what != LinkTrouble::kStop) {
      EXPECT_EQ(refbox_->wait(), what == LinkTrouble::kKill ? 128 + SIGKILL : 0) << refbox_->errors();
    }
    rig_.note_word(since_ns_ + 1'000 * kMs + kBusy_ns, false);
    play(1'300 * kMs);
    if (what == LinkTrouble::kStop) {
      rig_.note_word(steady_now_ns(), true);  // the box was there all the time
      return refbox_->signal(SIGCONT);
    }
    start();
  }

  hal::refbox::EmulatedBox box_{hal::refbox::BoxConfig{}};
  KickerRig rig_{troubled_ioboard(), settings_for(box_), false};
  bus::Reader<msg::Referee> words_{rig_.participant(), {.period = {}, .keep_all = true, .on_liveliness = {}}};
  std::optional<e2e::Program> refbox_;
  bool playing_ = false;
  std::uint64_t commands_ = 0;  // that the node has counted
  std::int64_t since_ns_ = 0, stopped_ns_ = 0;
};

TEST_F(RefboxCampaign, ALostBoxIsAStopWithinHalfASecondAndNothingFiresUntilANewStart) {
  ASSERT_TRUE(starts()) << "no first kick: " << refbox_->errors() << rig_.driver_errors();
  std::mt19937_64 random = device_draws();
  const std::uint64_t rounds = device_rounds(DeviceCampaigns::kRefbox);
  for (std::uint64_t round = 0; round < rounds; ++round) {
    const LinkTrouble what = kLinkTroubles[round % kLinkTroubles.size()];
    SCOPED_TRACE(fmt::format("round {}, {}", round, kLinkTroubleNames[round % kLinkTroubles.size()]));
    play(static_cast<std::int64_t>(random() % 300) * kMs);
    what < LinkTrouble::kKill ? lose_the_box(what) : lose_the_node(what);
    ASSERT_TRUE(box_.wait_for_teams(1, std::chrono::nanoseconds{kRecovery_ns})) << refbox_->errors();
    if (what == LinkTrouble::kStop) {
      ASSERT_TRUE(rig_.fires()) << "the game goes on";
      continue;
    }
    play(300 * kMs);
    EXPECT_FALSE(playing_) << "nobody has said START";
    ASSERT_TRUE(starts()) << refbox_->errors();
  }
  EXPECT_EQ(rig_.end(), "");
  const JudgedPulses judged = judge_pulses(rig_.timeline());
  EXPECT_THAT(judged.complaints, IsEmpty());
  EXPECT_THAT(unlogged(judged.kicks, rig_.log()), IsEmpty());
  EXPECT_GE(judged.kicks.size(), rounds) << "at least a kick a round, or this says nothing";
}

}  // namespace
}  // namespace trivela::faults
