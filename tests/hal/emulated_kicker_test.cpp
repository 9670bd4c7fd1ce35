// The board of a world's kicker and the backend of a robot, over the line between them.
#include "emulators/board/emulated_kicker.hpp"

#include <gmock/gmock.h>

#include "tests/hal/board_on_a_line.hpp"

namespace trivela::hal {
namespace {

using tests::kTimeout;
using tests::read_until;
using tests::steady_ns;
using tests::until_armed;

/// The path in `hal.ioboard.port="/tmp/..."`.
std::string address_in(const std::string& setting) {
  const std::size_t quote = setting.find('"');
  return setting.substr(quote + 1, setting.size() - quote - 2);
}

struct IoBoardHost {
  static constexpr double kStep = 128.0 / 100.0;  // of the board, in set-points
  config::IoBoardDevice settings{.pulse_us_per_power = 100.0, .charge_time_s = 0.0};
  std::unique_ptr<KickerBoard> board(const std::string& port) {
    settings.port = port;
    return std::make_unique<ioboard::IoBoard>(serial_line(port), settings);
  }
};
struct ReKickHost {
  static constexpr double kStep = 1.0 / 30.0;
  config::ReKickDevice settings{.pulse_us_per_power = 30.0};
  std::unique_ptr<KickerBoard> board(const std::string& port) {
    settings.port = port;
    return std::make_unique<rekick::ReKick>(can::can_line(port), settings);
  }
};

template <class Host>
class EmulatedKickerTest : public testing::Test {
 protected:
  std::vector<CoilPulse> pulses(std::size_t n) {
    std::vector<CoilPulse> all;
    const auto end = std::chrono::steady_clock::now() + kTimeout;
    while (all.size() < n && std::chrono::steady_clock::now() < end) {
      EXPECT_TRUE(kicker->read(kTimeout));  // the board is asked again, after what it was told before
      for (const CoilPulse& pulse : world->take_pulses()) all.push_back(pulse);
    }
    return all;
  }

  Host host;
  std::unique_ptr<EmulatedKicker> world = emulated_kicker(host.settings);
  std::unique_ptr<Kicker> kicker = tests::kicker_on(host.board(address_in(world->setting())));
};
using Hosts = testing::Types<IoBoardHost, ReKickHost>;
TYPED_TEST_SUITE(EmulatedKickerTest, Hosts);

TYPED_TEST(EmulatedKickerTest, AHostThatHasTheSettingFindsItAndAsksHowItStands) {
  EXPECT_THAT(this->world->setting(), testing::MatchesRegex("hal\\.(ioboard|rekick)\\.port=\"/.+\""));
  EXPECT_TRUE(this->world->wait_for_host(kTimeout));
}

TYPED_TEST(EmulatedKickerTest, TheWorldsArmSwitchIsTheBoards) {
  this->world->show(1.0, true);
  EXPECT_TRUE(until_armed(*this->kicker));
  this->world->show(1.0, false);
  EXPECT_TRUE(read_until(*this->kicker, [](const KickerSample& sample) { return !sample.armed; }));
}

TYPED_TEST(EmulatedKickerTest, AnOrderIsOnePulseAtItsInstantWithItsPowerToTheBoardsResolution) {
  this->world->show(1.0, true);
  ASSERT_TRUE(until_armed(*this->kicker));
  for (const double power : {15.0, 27.3}) {
    const std::int64_t t_ns = steady_ns() + 105'000'000;  // a ReKick is not told to kick again within 0.1 s
    this->kicker->fire({1, power, t_ns});
    const auto pulses = this->pulses(1);
    ASSERT_EQ(pulses.size(), 1u);
    EXPECT_GE(pulses[0].t_ns, t_ns);
    EXPECT_NEAR(pulses[0].power, power, TypeParam::kStep / 2);
  }
  EXPECT_TRUE(this->world->take_pulses().empty()) << "each is taken once";
}

TEST(EmulatedReKick, MeasuresTheChargeOfTheWorld) {
  const ReKickHost host;
  const auto world = emulated_kicker(host.settings);
  const auto kicker = tests::kicker_on(ReKickHost{}.board(address_in(world->setting())));
  for (const double charge : {1.0, 0.5, 0.9}) {
    world->show(charge, true);
    // The board says volts in whole ones: 1 of 330, twice that of the energy.
    EXPECT_TRUE(read_until(*kicker, [=](const KickerSample& s) { return std::abs(s.charge - charge) < 0.01; }));
  }
}

TEST(EmulatedKicker, AKickerOnTheBusHasNoBoard) { EXPECT_EQ(emulated_kicker(config::BusDevice{}), nullptr); }

}  // namespace
}  // namespace trivela::hal
