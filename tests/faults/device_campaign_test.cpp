// The kicker's driver, as its own process, with an emulated ioBoard at its line while the line and the process are
// troubled. The board's own record of its pulses is the witness. By hand, longer: TRIVELA_DEVICE_FAULTS=1000 and
// TRIVELA_DEVICE_SEED.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <vector>

#include "bus/reader.hpp"
#include "bus/writer.hpp"
#include "config/settings.hpp"
#include "hal/ioboard/emulator.hpp"
#include "hal/ioboard/io_board.hpp"
#include "idl/messages.hpp"
#include "tests/e2e/folder.hpp"
#include "tests/e2e/program.hpp"

namespace trivela::faults {
namespace {

using Clock = std::chrono::steady_clock;
using hal::ioboard::EmulatedBoard;
using std::chrono::milliseconds;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kOldest_ns = 100 * kMs;      // max_order_age_s, and the board's own patience after an instant
constexpr std::int64_t kLine_ns = 30 * kMs;         // to the emulator's thread on a busy machine
constexpr std::int64_t kRecovery_ns = 2'000 * kMs;  // what a robot may need
constexpr std::int64_t kLongest_ns = 500 * kMs;     // of a trouble
constexpr std::size_t kPowers = 25;                 // told apart by the length of their pulse

std::int64_t now_ns() { return Clock::now().time_since_epoch().count(); }

std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
  const char* const value = std::getenv(name);
  return value != nullptr ? std::stoull(value) : otherwise;
}

enum class Trouble { kUnplug, kHold, kSilent, kLost, kGarbled, kWrongSums, kFlood, kKill, kStop, kRestart };
constexpr std::array kTroubles{Trouble::kUnplug,  Trouble::kHold,      Trouble::kSilent, Trouble::kLost,
                               Trouble::kGarbled, Trouble::kWrongSums, Trouble::kFlood,  Trouble::kKill,
                               Trouble::kStop,    Trouble::kRestart};

/// What an order is made of, and whether anybody may fire it.
enum class Kind { kLawful, kStale, kWithoutBall, kOutOfRange, kStrangers };

struct Ordered {
  std::int64_t t_ns = 0;
  Kind kind = Kind::kLawful;
  std::uint8_t units = 0;  // of its pulse
};

class DeviceCampaign : public testing::Test {
 protected:
  DeviceCampaign() {
    settings_.hal.kicker = config::IoBoardDevice{.port = board_.address(), .charge_time_s = 0.2};
    std::ofstream{folder_ / "nodes.toml"} << config::to_toml_text(settings_);
    start();
  }

  static config::Settings settings() {
    config::Settings settings =
        config::load_settings(std::filesystem::path{TRIVELA_SOURCE_DIR} / "config/default.toml");
    std::random_device random;
    settings.run.lockstep = false;
    settings.domain.domain_id = 1 + random() % 100;
    settings.domain.tag = fmt::format("device-{}-{:08x}", getpid(), random());
    return settings;
  }

  void start() {
    driver_.emplace("trivela-kicker_driver", std::vector<std::string>{"--config", "nodes.toml"}, folder_.path());
  }

  /// Lets the match go on for so long: the referee's words and an order every 50 ms.
  void play(
      std::int64_t until_ns, const std::function<bool()>& done = [] { return false; }) {
    while (now_ns() < until_ns && !done()) {
      say();
      order();
      const std::size_t before = pulses().size();
      board_.wait(milliseconds(50), [&](const EmulatedBoard& board) { return board.pulses().size() > before; });
      take_receipts();
    }
  }

  void say() {
    msg::Referee word{};
    word.robot_id = 1;
    word.seq = ++words_;
    word.t_ns = now_ns();
    word.playing = playing_;
    if (said_.empty() || said_.rbegin()->second != playing_) said_[word.t_ns] = playing_;
    referee_.write(word);
  }

  void order() {
    const std::uint64_t draw = random_() % 6;
    write_order(decision_, draw < 3 ? Kind::kLawful : static_cast<Kind>(draw - 2));
  }

  /// Somebody with more strength than the decision node, who alone is heard meanwhile.
  void strangers() {
    bus::Writer<msg::KickOrder> stranger{
        participant_, {.period = {}, .lease = std::chrono::hours{1}, .strength = 10, .owner = "somebody"}};
    EXPECT_TRUE(stranger.wait_for_readers(1, std::chrono::seconds{5}));
    for (int i = 0; i < 4; ++i) {
      say();
      write_order(stranger, Kind::kStrangers);
      board_.wait(milliseconds(50), [](const EmulatedBoard&) { return false; });
    }
  }

  void write_order(bus::Writer<msg::KickOrder>& writer, Kind kind) {
    Ordered ordered{now_ns(), kind, static_cast<std::uint8_t>(20 + ids_ % kPowers)};
    msg::KickOrder out{};
    out.robot_id = 1;
    out.seq = out.kick_id = static_cast<std::int64_t>(++ids_);
    out.t_ns = out.fire_t_ns = ordered.t_ns - (kind == Kind::kStale ? 400 * kMs : 0);
    out.valid_until_t_ns = ordered.t_ns + 1'000 * kMs;
    out.power = kind == Kind::kOutOfRange ? 200.0 : ordered.units;
    out.possession = kind != Kind::kWithoutBall;
    ordered_[out.kick_id] = ordered;
    writer.write(out);
  }

  void take_receipts() {
    receipts_.take([&](const msg::KickReceipt& receipt) {
      if (receipt.accepted) accepted_[receipt.kick_id] = receipt.fired_t_ns;
    });
  }

  void trouble(Trouble what, std::int64_t for_ns) {
    troubles_[now_ns()] = what;
    const auto set = [&](auto change) { board_.with_board([&](EmulatedBoard& board) { change(board.faults); }); };
    switch (what) {
      case Trouble::kUnplug:
        board_.line().pull();
        play(now_ns() + for_ns);
        return board_.line().plug();
      case Trouble::kHold:
        board_.line().hold(true);
        play(now_ns() + for_ns);
        return board_.line().hold(false);
      case Trouble::kSilent:
        set([](auto& faults) { faults.silent = true; });
        break;
      case Trouble::kLost:
        set([](auto& faults) { faults.lost_every = 2; });
        break;
      case Trouble::kGarbled:
        set([](auto& faults) { faults.garbled_every = 2; });
        break;
      case Trouble::kWrongSums:
        set([](auto& faults) { faults.wrong_sums_every = 2; });
        break;
      case Trouble::kFlood:
        set([](auto& faults) { faults.floods = true; });
        break;
      case Trouble::kKill:
        driver_->signal(SIGKILL);
        killed_ns_.push_back(now_ns());
        driver_->wait();
        play(now_ns() + for_ns);
        return start();
      case Trouble::kStop:
        driver_->signal(SIGSTOP);
        play(now_ns() + for_ns);
        return driver_->signal(SIGCONT);
      case Trouble::kRestart:
        driver_->signal(SIGTERM);
        EXPECT_EQ(driver_->wait(), 0) << driver_->errors();
        return start();
    }
    play(now_ns() + for_ns);
    set([](auto& faults) { faults = {}; });
  }

  /// Whether a lawful order is fired within what a robot may need.
  bool recovers() {
    playing_ = true;
    const std::size_t before = pulses().size();
    play(now_ns() + kRecovery_ns, [&] { return pulses().size() > before; });
    return pulses().size() > before;
  }

  std::vector<EmulatedBoard::Pulse> pulses() {
    std::vector<EmulatedBoard::Pulse> found;
    board_.with_board([&](EmulatedBoard& board) { found = board.pulses(); });
    return found;
  }

  void judge(const EmulatedBoard::Pulse& pulse) {
    const auto order = order_of(pulse);
    EXPECT_TRUE(order) << "a pulse of " << int{pulse.units} << " units without a lawful fresh order of its own; "
                       << circumstances(pulse);
    auto word = said_.upper_bound(pulse.t_ns - kLine_ns);
    const bool stands = word != said_.begin() && !std::prev(word)->second;
    const bool starts_now = word != said_.end() && word->first <= pulse.t_ns;
    EXPECT_FALSE(stands && !starts_now) << "a pulse while the game stands";
    const bool cut = std::ranges::any_of(
        killed_ns_, [&](std::int64_t t_ns) { return t_ns >= pulse.t_ns && t_ns - pulse.t_ns < kOldest_ns; });
    EXPECT_TRUE(!order || accepted_.contains(*order) || cut) << "a pulse without a receipt";
  }

  /// Nobody can call back what is on its way when a line begins to hold back, which shows when an answer is missing.
  bool lay_in_the_line(std::int64_t ordered_t_ns) const {
    constexpr std::int64_t kUnnoticed_ns =
        20 * kMs + hal::KickerBoard::kDoubt_ns + kLine_ns;  // from a question to the doubt
    return std::ranges::any_of(troubles_, [&](const auto& trouble) {
      const std::int64_t after_ns = ordered_t_ns - trouble.first;
      return trouble.second == Trouble::kHold && after_ns > -kLine_ns && after_ns < kUnnoticed_ns;
    });
  }

  /// What was going on, and the last order of its power before it.
  std::string circumstances(const EmulatedBoard::Pulse& pulse) const {
    const auto trouble = troubles_.upper_bound(pulse.t_ns);
    std::string said = trouble == troubles_.begin() ? "before any trouble"
                                                    : fmt::format("{} ms after the start of trouble {}",
                                                                  (pulse.t_ns - std::prev(trouble)->first) / kMs,
                                                                  static_cast<int>(std::prev(trouble)->second));
    for (auto last = ordered_.rbegin(); last != ordered_.rend(); ++last) {
      if (last->second.units != pulse.units || last->second.t_ns > pulse.t_ns) continue;
      return said + fmt::format(", {} ms after order {} of kind {}", (pulse.t_ns - last->second.t_ns) / kMs,
                                last->first, static_cast<int>(last->second.kind));
    }
    return said;
  }

  /// The lawful order of a pulse: fresh, and nobody's before.
  std::optional<std::int64_t> order_of(const EmulatedBoard::Pulse& pulse) {
    for (const auto& [kick_id, ordered] : ordered_) {
      const std::int64_t age_ns = pulse.t_ns - ordered.t_ns;
      const std::int64_t oldest_ns = lay_in_the_line(ordered.t_ns) ? kLongest_ns : kOldest_ns;
      const bool fits = ordered.kind == Kind::kLawful && ordered.units == pulse.units && age_ns >= 0 &&
                        age_ns <= oldest_ns + kLine_ns;
      if (fits && fired_.insert(kick_id).second) return kick_id;
    }
    return std::nullopt;
  }

  config::Settings settings_ = settings();
  bus::Participant participant_{
      bus::loopback(static_cast<std::uint32_t>(settings_.domain.domain_id), settings_.domain.tag)};
  e2e::Folder folder_;
  hal::ioboard::Emulator board_;
  bus::Writer<msg::Referee> referee_{participant_};
  bus::Writer<msg::KickOrder> decision_{
      participant_, {.period = {}, .lease = std::chrono::hours{1}, .strength = 0, .owner = "kick_decision/1"}};
  bus::Reader<msg::KickReceipt> receipts_{participant_};
  std::optional<e2e::Program> driver_;
  std::mt19937_64 random_{from_environment("TRIVELA_DEVICE_SEED", 1)};
  std::map<std::int64_t, Ordered> ordered_;
  std::map<std::int64_t, std::int64_t> accepted_;  // fired_t_ns by kick_id
  std::set<std::int64_t> fired_;
  std::uint64_t ids_ = 0, words_ = 0;
  bool playing_ = true;
  std::map<std::int64_t, bool> said_;         // when the referee changed his word
  std::map<std::int64_t, Trouble> troubles_;  // when they began
  std::vector<std::int64_t> killed_ns_;       // when the driver was
};

TEST_F(DeviceCampaign, NoPulseWithoutALawfulFreshOrderInPlayAndAReceipt) {
  ASSERT_TRUE(recovers()) << "no first kick: " << driver_->errors();
  const std::uint64_t rounds = from_environment("TRIVELA_DEVICE_FAULTS", kTroubles.size());
  for (std::uint64_t round = 0; round < rounds; ++round) {
    const Trouble what = kTroubles[round % kTroubles.size()];
    SCOPED_TRACE(fmt::format("round {}, trouble {}", round, static_cast<int>(what)));
    strangers();
    playing_ = random_() % 4 != 0;
    trouble(what, static_cast<std::int64_t>(50 + random_() % 450) * kMs);
    ASSERT_TRUE(recovers()) << driver_->errors();
    playing_ = false;
    play(now_ns() + 150 * kMs);
  }
  driver_->signal(SIGTERM);
  EXPECT_EQ(driver_->wait(), 0) << driver_->errors();
  take_receipts();
  for (const EmulatedBoard::Pulse& pulse : pulses()) judge(pulse);
  EXPECT_GE(fired_.size(), rounds) << "at least a kick a round, or this says nothing";
}

}  // namespace
}  // namespace trivela::faults
