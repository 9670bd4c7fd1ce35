// The hub between real hosts: network namespaces with a TAP each, and sockets in them.
#include "tests/faults/hub.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sched.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <string>
#include <thread>

#include "tests/faults/network_host.hpp"

namespace trivela::faults {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kTimeout{20};
constexpr std::chrono::milliseconds kSilence{300};
constexpr std::uint16_t kPort = 7777;

sockaddr_in address_of(std::uint8_t number) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(kPort);
  address.sin_addr.s_addr = htonl(0x0a4d0000u + number);
  return address;
}

/// A UDP socket on a host.
class Socket {
 public:
  Socket(const NetworkHost& host, std::uint8_t number) {
    std::thread{[&] {
      if (setns(host.network(), CLONE_NEWNET) != 0) return;
      socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
      const sockaddr_in address = address_of(number);
      bound_ = bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    }}.join();
  }
  ~Socket() { close(socket_); }
  bool bound() const { return bound_; }
  void say(const std::string& text, std::uint8_t to) const {
    const sockaddr_in address = address_of(to);
    sendto(socket_, text.data(), text.size(), 0, reinterpret_cast<const sockaddr*>(&address), sizeof address);
  }
  /// The next datagram; empty: none came in time.
  std::string receive(std::chrono::milliseconds timeout) const {
    pollfd source{socket_, POLLIN, 0};
    if (poll(&source, 1, static_cast<int>(timeout.count())) != 1) return {};
    char buffer[100];
    const ssize_t size = recv(socket_, buffer, sizeof buffer, 0);
    return {buffer, static_cast<std::size_t>(size)};
  }

 private:
  int socket_ = -1;
  bool bound_ = false;
};

class HubTest : public testing::Test {
 protected:
  void SetUp() override {
    const std::string obstacle = NetworkHost::obstacle();
    if (!obstacle.empty()) GTEST_SKIP() << "no network namespaces here: " << obstacle;
    for (std::uint8_t number = 1; number <= 3; ++number) hosts.emplace_back(number);
    hub = std::make_unique<Hub>(
        std::vector<Hub::Cable>{{hosts[0].cable(), 1}, {hosts[1].cable(), 2}, {hosts[2].cable(), 3}}, 1);
    for (std::uint8_t number = 1; number <= 3; ++number)
      sockets.push_back(std::make_unique<Socket>(hosts[number - 1], number));
    // Hosts that know each other's MAC address: afterwards a frame is a datagram.
    for (std::uint8_t to = 2; to <= 3; ++to) {
      sockets[0]->say("hello", to);
      ASSERT_EQ(sockets[to - 1]->receive(kTimeout), "hello");
    }
  }

  std::vector<NetworkHost> hosts;
  std::unique_ptr<Hub> hub;
  std::vector<std::unique_ptr<Socket>> sockets;
};

TEST_F(HubTest, ACutEndsOneWayAndNoOther) {
  hub->set({{{0, 1}, Way{.drop = 1.0}}});
  sockets[0]->say("cut", 2);
  sockets[0]->say("sound", 3);
  EXPECT_EQ(sockets[2]->receive(kTimeout), "sound");
  EXPECT_EQ(sockets[1]->receive(kSilence), "");
  sockets[1]->say("back", 1);
  EXPECT_EQ(sockets[0]->receive(kTimeout), "back");
  hub->set({});
  sockets[0]->say("again", 2);
  EXPECT_EQ(sockets[1]->receive(kTimeout), "again");
  EXPECT_GE(hub->counts().dropped, 1u);
}

TEST_F(HubTest, ADelayedFrameComesLateAndWhole) {
  hub->set({{{0, 1}, Way{.delay = std::chrono::milliseconds{150}, .jitter = std::chrono::milliseconds{50}}}});
  const auto said = Clock::now();
  sockets[0]->say("late", 2);
  EXPECT_EQ(sockets[1]->receive(kTimeout), "late");
  EXPECT_GE(Clock::now() - said, std::chrono::milliseconds{150});
}

TEST_F(HubTest, AGarbledDatagramReachesTheProgram) {
  hub->set({{{0, 1}, Way{.garble = 1.0}}});
  const std::string text(64, 'x');
  sockets[0]->say(text, 2);
  const std::string received = sockets[1]->receive(kTimeout);
  EXPECT_EQ(received.size(), text.size());
  EXPECT_NE(received, text);
}

}  // namespace
}  // namespace trivela::faults
