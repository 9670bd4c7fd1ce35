#include "pages/serve/site.hpp"

#include <gtest/gtest.h>

#include "config/text/error.hpp"

namespace trivela::pages {
namespace {

TEST(SameSite, AddressesAndOwnNamesNameThisMachine) {
  for (const char* const host : {"127.0.0.1:8080", "192.168.0.7", "[::1]:80", "[fe80::1]", "localhost", "localhost:1",
                                 "robot", "robot:80", "robot.local"}) {
    EXPECT_TRUE(names_this_machine(host, "robot")) << host;
  }
}

TEST(SameSite, CapitalsAndTheShortNameAreTheSameMachine) {
  EXPECT_TRUE(names_this_machine("robot-pc:8080", "Robot-PC"));
  EXPECT_TRUE(names_this_machine("ROBOT.lan", "robot.lan"));
  EXPECT_TRUE(names_this_machine("robot", "robot.lan"));
  EXPECT_FALSE(names_this_machine("lan", "robot.lan"));
}

TEST(SameSite, OtherNamesMayBeAnybodys) {
  for (const char* const host : {"", "evil.example", "evil.example:80", "localhost.evil.example",
                                 "127.0.0.1.evil.example", "robot.example", "roboter"}) {
    EXPECT_FALSE(names_this_machine(host, "robot")) << host;
  }
}

TEST(SameSite, OnlyThePagesOwnOriginMayCommand) {
  EXPECT_TRUE(same_origin("http://127.0.0.1:8080", "127.0.0.1:8080"));
  EXPECT_TRUE(same_origin("", "127.0.0.1:8080")) << "no browser's page";
  EXPECT_FALSE(same_origin("http://127.0.0.1:8081", "127.0.0.1:8080"));
  EXPECT_FALSE(same_origin("https://127.0.0.1:8080", "127.0.0.1:8080"));
  EXPECT_FALSE(same_origin("http://evil.example", "127.0.0.1:8080"));
  EXPECT_FALSE(same_origin("null", "127.0.0.1:8080"));
}

TEST(ListenAddress, HasAHostAndMaybeAPort) {
  const auto expect = [](const char* text, const char* host, int port) {
    const ListenAddress address = parse_listen(text, 7);
    EXPECT_EQ(address.host, host) << text;
    EXPECT_EQ(address.port, port) << text;
  };
  expect("0.0.0.0", "0.0.0.0", 7);
  expect("0.0.0.0:8080", "0.0.0.0", 8080);
  expect("[::1]:8080", "::1", 8080);
  expect("[::]", "::", 7);
  for (const char* const text : {"127.0.0.1:", "127.0.0.1:x", "127.0.0.1:-1", "127.0.0.1:65536"}) {
    EXPECT_THROW(parse_listen(text, 7), config::BadArgument) << text;
  }
}

}  // namespace
}  // namespace trivela::pages
