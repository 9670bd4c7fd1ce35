// What `trivela hardware` says before it looks or asks: devices that somebody else has, kickers that could not fire.
#include <gmock/gmock.h>

#include "cli/hardware/tasks.hpp"

namespace trivela::cli {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::StartsWith;

hal::KickerSample armed() {
  hal::KickerSample sample;
  sample.armed = true;
  return sample;
}

TEST(DevicesOfSomebodyElse, AreNotOpenedAndNotCalledThere) {
  DeviceProbes probes;
  probes.push_back(held_by("wheels", "cia402 on can0", "odometry"));
  EXPECT_THAT(listing(probes),
              ContainsRegex("wheels +cia402 on can0 +not opened: odometry or another trivela hardware has it\n"));
  EXPECT_FALSE(all_answer(probes)) << "nobody looked";
}

TEST(DevicesOfSomebodyElse, ABoxThatNobodyNamedIsNone) {
  config::Refbox settings;
  EXPECT_FALSE(is_wanted(settings));
  settings.group = "224.16.32.39";
  EXPECT_TRUE(is_wanted(settings));
  DeviceProbes probes;
  probes.push_back(referee_box_probe({}));
  EXPECT_TRUE(all_answer(probes)) << "none is wanted";
}

TEST(ATestKick, IsAskedForWhereTheKickerCouldFire) {
  EXPECT_EQ(refused_at_once(armed(), config::IoBoardDevice{}, "ioBoard version 3"), "");
}

TEST(ATestKick, NamesTheSwitchThatIsOpen) {
  EXPECT_THAT(
      refused_at_once({}, config::IoBoardDevice{}, ""),
      AllOf(StartsWith("refused, unarmed: the in-play or the software-on switch is open"), HasSubstr("charge")));
  EXPECT_THAT(refused_at_once({}, config::ReKickDevice{}, ""), HasSubstr("the kicker's supply is off"));
  EXPECT_THAT(refused_at_once({}, config::BusDevice{}, ""), HasSubstr("the arm switch is open"));
}

TEST(ATestKick, OfALostLinkSaysWhatTheLinkSays) {
  hal::KickerSample sample = armed();
  sample.fault = hal::KickerFault::kLink;
  EXPECT_THAT(refused_at_once(sample, config::IoBoardDevice{}, "/dev/kicker: No such file"),
              AllOf(StartsWith("refused, fault"), HasSubstr("link lost; /dev/kicker: No such file")));
}

}  // namespace
}  // namespace trivela::cli
