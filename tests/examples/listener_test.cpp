#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>

#include "bus/writer.hpp"
#include "idl/messages.hpp"
#include "tests/nodes/spawned.hpp"

namespace trivela {
namespace {

TEST(Examples, TheListenerHearsEveryDecision) {
  const std::string tag = "examples-test-" + std::to_string(getpid());
  bus::Writer<msg::KickDecision> writer{bus::Participant{bus::loopback(19, tag)}};
  nodes::Spawned listener{TRIVELA_BINARY_DIR "/examples/listen_to_decisions", {"19", tag}};
  ASSERT_TRUE(writer.wait_for_readers(1, std::chrono::seconds{30})) << listener.said();
  msg::KickDecision decision{};
  decision.robot_id = 3;
  decision.t_ns = 1'500'000'000;
  decision.policy = msg::POLICY_MOVING;
  decision.reason = msg::REASON_NOT_ALIGNED;
  decision.power = 31.5;
  decision.distance_m = 4.25;
  writer.write(decision);
  EXPECT_TRUE(listener.says("robot 3, 1.50 s, moving: hold (not_aligned), power 31.50, 4.25 m\n")) << listener.said();
  decision.t_ns += 20'000'000;
  decision.fire = true;
  decision.reason = msg::REASON_FIRE;
  writer.write(decision);
  EXPECT_TRUE(listener.says("robot 3, 1.52 s, moving: fire (fire), power 31.50, 4.25 m\n")) << listener.said();
}

}  // namespace
}  // namespace trivela
