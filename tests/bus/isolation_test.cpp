#include <gtest/gtest.h>

#include "bus/reader.hpp"
#include "bus/writer.hpp"
#include "idl/messages.hpp"
#include "tests/bus/test_domain.hpp"

namespace trivela::bus {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

DomainConfig with_tag(DomainConfig config, const std::string& tag) {
  const auto begin = config.xml.find("<Tag>") + 5;
  config.xml.replace(begin, config.xml.find("</Tag>") - begin, tag);
  return config;
}

// Both hear the one in the middle's domain id and ports; only the tag tells them apart.
TEST(Isolation, TwoTagsInOneDomainNeverHearEachOther) {
  const auto wire = fresh_wire_pair();
  const auto other_config = with_tag({wire.b.domain_id % 100 + 1, wire.b.xml}, "other");
  ASSERT_NE(other_config.xml, wire.b.xml);
  Reader<msg::Referee> other{Participant(other_config)};
  Writer<msg::Referee> writer{Participant(wire.a)};
  msg::Referee referee{};
  referee.robot_id = 1;
  writer.write(referee);
  // A reader of the same tag that came later has long matched and been served.
  Reader<msg::Referee> friendly{Participant(wire.b)};
  ASSERT_TRUE(friendly.wait(seconds(10)));
  EXPECT_FALSE(other.wait(milliseconds(100)));
  EXPECT_EQ(other.writers(), 0u);
  EXPECT_EQ(writer.readers(), 1u);
}

}  // namespace
}  // namespace trivela::bus
