#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "bus/domain/cyclone.hpp"
#include "bus/domain/domain.hpp"

namespace trivela::bus {
namespace {

using ::testing::HasSubstr;

std::string message_of(auto&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(DomainConfig, LoopbackIsTheConfigurationFileWithTheTagPutIn) {
  std::ifstream file(TRIVELA_SOURCE_DIR "/config/cyclonedds/loopback.xml");
  std::ostringstream text;
  text << file.rdbuf();
  std::string expected = text.str();
  const std::string placeholder = "${TRIVELA_TAG:-trivela}";
  ASSERT_NE(expected.find(placeholder), std::string::npos);
  expected.replace(expected.find(placeholder), placeholder.size(), "run-7");
  EXPECT_EQ(loopback(3, "run-7").xml, expected);
  EXPECT_EQ(loopback(3, "run-7").domain_id, 3u);
}

TEST(DomainConfig, ADomainWhosePortsMayBeTakenIsRefused) {
  EXPECT_NO_THROW(loopback(0, "t"));
  EXPECT_NO_THROW(loopback(100, "t"));
  EXPECT_THAT(message_of([] { loopback(101, "t"); }), HasSubstr("domain id 101): must be 0..100"));
  EXPECT_THAT(message_of([] { from_file(230, "x.xml"); }), HasSubstr("domain id 230"));
}

TEST(DomainConfig, ATagThatWouldChangeTheConfigurationIsRefused) {
  EXPECT_THAT(message_of([] { loopback(1, "</Tag>"); }), HasSubstr("</Tag>"));
  EXPECT_THAT(message_of([] { loopback(1, ""); }), HasSubstr("tag \"\""));
}

TEST(DomainConfig, AMissingFileIsNamed) {
  EXPECT_THAT(message_of([] { from_file(1, "/nowhere/team.xml"); }), HasSubstr("/nowhere/team.xml"));
}

TEST(DomainConfig, AFileIsTakenAsItStands) {
  const auto config = from_file(2, TRIVELA_SOURCE_DIR "/config/cyclonedds/loopback.xml");
  EXPECT_THAT(config.xml, HasSubstr("${TRIVELA_TAG:-trivela}"));
}

}  // namespace
}  // namespace trivela::bus
