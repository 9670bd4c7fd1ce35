// The stack among its own packets with bits turned over: what remains when that is over.
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <sstream>

#include "tests/e2e/log_rows.hpp"
#include "tests/faults/own_network.hpp"
#include "tests/faults/packet_mutator.hpp"
#include "tests/faults/real_time_stack.hpp"
#include "tests/faults/rtps_packet.hpp"
#include "tests/faults/stream_witness.hpp"

namespace trivela::faults {
namespace {

std::string from_environment(const char* name, const std::string& otherwise) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : otherwise;
}

Mutations wished() {
  Mutations mutations;
  mutations.seed = std::stoull(from_environment("TRIVELA_FLOOD_SEED", "1"));
  mutations.share = std::stod(from_environment("TRIVELA_FLOOD_SHARE", "1"));
  mutations.from = std::stoull(from_environment("TRIVELA_FLOOD_FROM", "0"));
  mutations.to = std::stoull(from_environment("TRIVELA_FLOOD_TO", "65536"));
  std::istringstream names{from_environment("TRIVELA_FLOOD_ONLY", "")};
  for (std::string name; std::getline(names, name, ',');) mutations.only.push_back(submessage_named(name));
  const std::string between = from_environment("TRIVELA_FLOOD_BETWEEN", "all");
  mutations.discovery = between != "user";
  mutations.user_data = between != "discovery";
  return mutations;
}

const std::vector<std::string> kTables{"odometry",     "vision_frames",  "flight_frames", "referee",
                                       "world_states", "drive_commands", "kicker_status"};

std::map<std::string, std::int64_t> rows(const RealTimeStack& stack) {
  const e2e::Reader log{stack.log()};
  std::map<std::string, std::int64_t> counts;
  for (const auto& table : kTables) counts[table] = e2e::number_of(log, "SELECT count(*) FROM " + table);
  return counts;
}

TEST(MutatedPackets, EveryStreamIsHeardAgainSoonAfterwards) {
  const double flood_s = std::stod(from_environment("TRIVELA_FLOOD_S", "5"));
  const double patience_s = std::stod(from_environment("TRIVELA_FLOOD_PATIENCE_S", "10"));
  RealTimeStack stack{(flood_s + patience_s) / 60.0 + 2.0};
  {
    PacketMutator mutator{wished()};
    StreamWitness witness{stack.settings()};
    witness.deaf_within(std::chrono::milliseconds{static_cast<int>(flood_s * 1e3)});
    mutator.stop();
    fmt::print("{} packets, {} mutated copies\n", mutator.seen(), mutator.sent());
  }
  fmt::print("stderr right after: {}\n", stack.said());
  const auto over = std::chrono::steady_clock::now();
  std::vector<std::string> deaf;
  const auto passed_s = [&] { return std::chrono::duration<double>{std::chrono::steady_clock::now() - over}.count(); };
  do {
    StreamWitness witness{stack.settings()};
    const auto before = rows(stack);
    deaf = witness.deaf_within(std::chrono::milliseconds{2000});
    for (const auto& [table, count] : rows(stack))
      if (count < before.at(table) + 20) deaf.push_back("recorder hears " + table);
    fmt::print("{:.1f} s after: deaf: {}\n", passed_s(), deaf);
    std::fflush(stdout);
  } while (!deaf.empty() && passed_s() < patience_s);
  EXPECT_THAT(deaf, testing::IsEmpty());
  EXPECT_EQ(stack.casualties(), "");
  fmt::print("stderr: {}\n", stack.said());
  for (const char* node : {"recorder", "world_state", "kick_decision"})
    fmt::print("--- {}\n{}\n", node, stack.errors_of(node).substr(0, 2500));
  for (const auto& sentence : e2e::losses_of(e2e::Reader{stack.log()})) fmt::print("{}\n", sentence);
}

}  // namespace
}  // namespace trivela::faults

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (!testing::GTEST_FLAG(list_tests)) trivela::faults::enter_own_network();
  return RUN_ALL_TESTS();
}
