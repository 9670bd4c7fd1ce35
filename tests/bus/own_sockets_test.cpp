#include "bus/domain/process.hpp"

#include <gmock/gmock.h>

#include "bus/domain/participant.hpp"
#include "tests/bus/test_domain.hpp"

namespace trivela::bus {
namespace {

TEST(OwnSockets, ADomainOnTheLoopbackOpensNoneThatAnotherInterfaceReaches) {
  const auto before = open_to_all();
  const Participant participant{fresh_domain()};
  EXPECT_EQ(open_to_all(), before);
}

TEST(OwnSockets, ADomainThatNamesNoInterfaceIsLeftAsCycloneOpensIt) {
  const auto before = open_to_all();
  DomainConfig domain = fresh_domain();
  const std::string element = R"(<Interfaces><NetworkInterface name="lo"/></Interfaces>)";
  domain.xml.erase(domain.xml.find(element), element.size());
  const Participant participant{domain};
  EXPECT_GT(open_to_all().size(), before.size());
}

TEST(OwnSockets, OnlyTheLoopbackByItselfIsTheLoopbackAlone) {
  EXPECT_TRUE(loopback_alone(R"(<NetworkInterface name="lo"/>)"));
  EXPECT_TRUE(loopback_alone(R"(<NetworkInterface name="lo" multicast="true"/>)"));
  EXPECT_FALSE(loopback_alone(R"(<NetworkInterface name="lo1"/>)"));
  EXPECT_FALSE(loopback_alone(R"(<NetworkInterface name="lo"/><NetworkInterface name="wlan0"/>)"));
  EXPECT_FALSE(loopback_alone(R"(<NetworkInterface name="wlan0"/>)"));
  EXPECT_FALSE(loopback_alone(""));
}

}  // namespace
}  // namespace trivela::bus
