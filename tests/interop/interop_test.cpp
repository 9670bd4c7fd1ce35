// Another vendor's DDS, Fast DDS, on our bus: what it says is decided upon, and what we decide it reads, each field.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "bus/stop.hpp"
#include "bus/writer.hpp"
#include "idl/messages.hpp"
#include "tests/interop/value_text.hpp"
#include "tests/nodes/spawned.hpp"
#include "tests/support/folder.hpp"

/// Of our types, which lie where C has them.
template <class F>
void visit_fields(const trivela_msg_ShadowDecision& value, F&& f) {
  trivela::bus::visit_fields(
      value, [&](std::string_view name, std::string_view, const auto& field) { f(std::string{name}.c_str(), field); });
}

namespace trivela::interop {
namespace {

using nodes::Spawned;
using ::testing::HasSubstr;

constexpr std::chrono::seconds kPlenty{60};

std::string text_of(const msg::KickDecision& decision) {
  FieldText text;
  bus::visit_fields(decision, [&](std::string_view name, std::string_view, const auto& field) {
    text(std::string{name}.c_str(), field);
  });
  return "decision\n" + text.out + "end\n";
}

/// Another value in each field, below what each of them holds; alternating where it is a boolean.
struct Different {
  int n = 0;

  template <class T>
  void operator()(std::string_view, std::string_view, T& value) {
    if constexpr (std::is_same_v<T, char[32]>) {
      std::snprintf(value, sizeof value, "own_%d", ++n);
    } else if constexpr (std::is_array_v<T>) {
      for (auto& element : value) bus::visit_fields(element, *this);
    } else if constexpr (std::is_same_v<T, bool>) {
      value = ++n % 2 == 0;
    } else if constexpr (std::is_enum_v<T>) {
      value = static_cast<T>(++n % 7);
    } else {
      value = static_cast<T>(++n * (std::is_integral_v<T> && sizeof(T) == 1 ? 1.0 : 1.000000119));
    }
  }
};

/// Says it every 10 ms in a thread of its own while it lives.
class Repeated {
 public:
  explicit Repeated(std::function<void()> say)
      : thread_{[this, say = std::move(say)] {
          do say();
          while (!stop_.wait_until(std::chrono::steady_clock::now() + std::chrono::milliseconds{10}));
        }} {}
  Repeated(const Repeated&) = delete;
  Repeated& operator=(const Repeated&) = delete;
  ~Repeated() { stop_.request(); }

 private:
  bus::Stop stop_;
  std::jthread thread_;
};

/// A domain without a tag, which another vendor would not know, with our bridge and the other's peer in it.
class Interop : public testing::Test {
 protected:
  static constexpr const char* kBus = TRIVELA_SOURCE_DIR "/examples/ros2/loopback.xml";

  static std::uint32_t fresh_domain() {
    static std::atomic<std::uint32_t> count = 0;
    return 1 + (static_cast<std::uint32_t>(getpid()) * 7 + count++) % 100;
  }
  void start_others() {
    ::setenv("CYCLONEDDS_URI", (std::string{"file://"} + kBus).c_str(), 1);
    const std::string id = std::to_string(domain);
    bridge.emplace(TRIVELA_BINARY_DIR "/examples/ros2/ros2_bridge", std::vector{id});
    peer.emplace(TRIVELA_BINARY_DIR "/tests/fastdds_peer", std::vector{id});
  }
  /// The number of a field in what the peer has read last.
  std::string peer_read(const std::string& field) const {
    const std::string& said = peer->said();
    const auto end = said.rfind("\nend\n"), at = said.rfind("\n" + field + " ", end);
    return said.substr(at + field.size() + 2, said.find('\n', at + 1) - at - field.size() - 2);
  }

  const std::uint32_t domain = fresh_domain();
  bus::Participant participant{bus::from_file(domain, kBus)};
  std::optional<Spawned> bridge, peer;
};

TEST_F(Interop, EachFieldOfADecisionIsReadAsItWasWritten) {
  start_others();
  bus::Writer<msg::KickDecision> decisions{participant};
  // The bridge's copy is volatile, as every event: it is repeated until the peer is there.
  ASSERT_TRUE(decisions.wait_for_readers(1, kPlenty)) << bridge->said();
  msg::KickDecision decision{};
  Different different;
  bus::visit_fields(decision, different);
  decision.offset_right_m = std::nan("");
  const Repeated repeated{[&] { decisions.write(decision); }};
  const bool received = peer->says("\nend\n");
  ASSERT_TRUE(received) << peer->said() << bridge->said();
  EXPECT_THAT(peer->said(), HasSubstr(text_of(decision)));
}

// Fast DDS 2.9 knows one representation of data and does not look at which a writer offers: hence the copy.
TEST_F(Interop, ADecisionAsItIsIsMatchedWhateverItsRepresentation) {
  bus::Writer<msg::KickDecision> decisions{participant};
  peer.emplace(TRIVELA_BINARY_DIR "/tests/fastdds_peer", std::vector{std::to_string(domain)});
  ASSERT_TRUE(peer->says("kick_decision as it is: ")) << peer->said();
  ASSERT_TRUE(peer->says("\n"));
  EXPECT_THAT(peer->said(), HasSubstr("kick_decision as it is: matched\n"));
}

TEST_F(Interop, TheNodeDecidesOnAWorldOfAnotherVendorAndIsReadByIt) {
  start_others();
  const tests::Folder folder;
  std::ofstream{folder / "node.toml"} << "[domain]\ndomain_id = " << domain << "\ndds_file = \"" << kBus << "\"\n"
                                      << "[run]\nlockstep = false\nrobot = \"" TRIVELA_SOURCE_DIR
                                         "/config/robots/cambada_1.toml\"\n";
  bus::Writer<msg::KickerStatus> statuses{participant};
  Spawned node{TRIVELA_BINARY_DIR "/trivela-kick_decision", {"--config", (folder / "node.toml").string()}};
  ASSERT_TRUE(statuses.wait_for_readers(1, kPlenty)) << node.said();
  const Repeated kicker{[&, status = msg::KickerStatus{}]() mutable {
    status.robot_id = 1;
    ++status.seq;
    status.t_ns = std::chrono::nanoseconds{std::chrono::steady_clock::now().time_since_epoch()}.count();
    status.ready = true;
    status.charge = 0.97;
    statuses.write(status);
  }};
  // The robot stands before the goal, its kicker is ready: it fires, and goes on deciding.
  const bool fired = peer->says("\nfire 1\n") && peer->says("\nend\n");
  ASSERT_TRUE(fired) << node.said() << peer->said();
  EXPECT_EQ(peer_read("possession_id"), "7");
  EXPECT_EQ(peer_read("x_m"), "0x1p-2");
  EXPECT_EQ(peer_read("y_m"), "0x1.8p+1");
  EXPECT_EQ(peer_read("opponent_distance_m"), "nan");
}

}  // namespace
}  // namespace trivela::interop
