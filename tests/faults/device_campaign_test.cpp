// The kicker's driver, as its own process, with an emulated board at its line while the line and the process are
// troubled. The board's own record of its pulses, and the recorder's log, are the witnesses. By hand, longer:
// TRIVELA_DEVICE_FAULTS=1000 and TRIVELA_DEVICE_SEED.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include "tests/faults/kicker_rig.hpp"

namespace trivela::faults {
namespace {

using testing::IsEmpty;

struct Board {
  const char* name;
  DeviceCampaigns campaign;
  std::unique_ptr<TroubledBoard> (*make)();
};

class KickerCampaign : public testing::TestWithParam<Board> {};

TEST_P(KickerCampaign, NoPulseWithoutALawfulFreshOrderInPlayAndAReceiptOrACountedGapInTheLog) {
  KickerRig rig{GetParam().make(), settings_of_campaign(), true};
  std::mt19937_64 random = device_draws();
  ASSERT_TRUE(rig.fires()) << "no first kick: " << rig.driver_errors();
  const std::vector<Trouble> troubles = rig.board().troubles();
  const std::uint64_t rounds = device_rounds(GetParam().campaign);
  for (std::uint64_t round = 0; round < rounds; ++round) {
    const Trouble what = troubles[round % troubles.size()];
    SCOPED_TRACE(fmt::format("round {}, {}", round, name(what)));
    rig.unauthorised_orders();
    rig.let_play(random() % 4 != 0);
    rig.suffer(what, static_cast<std::int64_t>(50 + random() % 450) * kMs);
    rig.let_play(true);
    ASSERT_TRUE(rig.fires()) << rig.driver_errors();
    rig.let_play(false);
    rig.play(steady_now_ns() + 150 * kMs);
  }
  EXPECT_EQ(rig.end(), "");
  const JudgedPulses judged = judge_pulses(rig.timeline());
  EXPECT_THAT(judged.complaints, IsEmpty());
  EXPECT_THAT(unlogged(judged.kicks, rig.log()), IsEmpty());
  EXPECT_GE(judged.kicks.size(), rounds) << "at least a kick a round, or this says nothing";
}

TEST_P(KickerCampaign, NoPulseIsLateWhereTheDriverStandsStillFromAnOrderOn) {
  KickerRig rig{GetParam().make(), settings_of_campaign(), true};
  std::mt19937_64 random = device_draws();
  ASSERT_TRUE(rig.fires()) << "no first kick: " << rig.driver_errors();
  const std::uint64_t rounds = device_rounds(GetParam().campaign);
  for (std::uint64_t round = 0; round < rounds; ++round) {
    SCOPED_TRACE(round);
    rig.suffer(Trouble::kStop, static_cast<std::int64_t>(150 + random() % 250) * kMs);
    ASSERT_TRUE(rig.fires()) << rig.driver_errors();
  }
  EXPECT_EQ(rig.end(), "");
  EXPECT_THAT(judge_pulses(rig.timeline()).complaints, IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Boards, KickerCampaign,
                         testing::Values(Board{"ioboard", DeviceCampaigns::kIoBoard, troubled_ioboard},
                                         Board{"rekick", DeviceCampaigns::kReKick, troubled_rekick}),
                         [](const auto& of) { return std::string{of.param.name}; });

}  // namespace
}  // namespace trivela::faults
