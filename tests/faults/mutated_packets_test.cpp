// The stack among its own packets with bits turned over: what remains when that is over. By hand, longer or narrower:
// TRIVELA_FLOOD_S, _PATIENCE_S, _SEED, _SHARE, _ONLY=HEARTBEAT,GAP,..., _BETWEEN=user or discovery, _FROM and _TO
// (bytes of the submessage).
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <functional>
#include <map>
#include <sstream>

#include "bus/domain/cyclone.hpp"
#include "bus/renewal.hpp"
#include "bus/writer.hpp"
#include "idl/messages.hpp"
#include "tests/bus/test_domain.hpp"
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

std::string deaf_recorder(const std::map<std::string, std::int64_t>& before,
                          const std::map<std::string, std::int64_t>& after) {
  std::string deaf;
  for (const auto& [table, count] : after)
    if (count < before.at(table) + 20) deaf += " recorder hears " + table;
  return deaf;
}

/// Counters that no loss can have brought about, as sentences.
std::vector<std::string> implausible_counters(const RealTimeStack& stack, double lasted_s) {
  std::vector<std::string> found;
  // 50 samples a second were written; 100 numbers may be skipped at once before a jump is doubted.
  const auto most = static_cast<std::int64_t>(1000.0 * lasted_s);
  const e2e::Reader log{stack.log()};
  for (const char* counter : {"lost", "gaps", "overflow", "nan_refused", "rejected", "out_of_order"}) {
    const auto count = e2e::number_of(log, fmt::format("SELECT max({}) FROM losses", counter));
    if (count < 0 || count > most) found.push_back(fmt::format("{} = {}", counter, count));
  }
  for (const auto& table : kTables) {
    const auto highest = e2e::number_of(log, "SELECT max(seq) FROM " + table);
    if (highest > most) found.push_back(fmt::format("{}.seq = {}", table, highest));
  }
  return found;
}

TEST(MutatedPackets, EveryStreamIsHeardAgainSoonAfterwards) {
  const double flood_s = std::stod(from_environment("TRIVELA_FLOOD_S", "5"));
  const double timeout_s = std::stod(from_environment("TRIVELA_FLOOD_PATIENCE_S", "10"));
  const bus::LibraryLog unheard{[](bool, std::string_view) {}};
  RealTimeStack stack{(flood_s + timeout_s) / 60.0 + 2.0};
  {
    PacketMutator mutator{wished()};
    StreamWitness{stack.settings()}.deaf_within(std::chrono::milliseconds{static_cast<int>(flood_s * 1e3)});
    mutator.stop();
    fmt::print("{} packets, {} mutated copies\n", mutator.seen(), mutator.sent());
  }
  const auto over = std::chrono::steady_clock::now();
  const auto passed_s = [&] { return std::chrono::duration<double>{std::chrono::steady_clock::now() - over}.count(); };
  std::string deaf;
  do {
    StreamWitness witness{stack.settings()};
    const auto before = rows(stack);
    deaf = fmt::format("{}", fmt::join(witness.deaf_within(std::chrono::seconds{2}), ", "));
    deaf += deaf_recorder(before, rows(stack));
    fmt::print("{:.1f} s afterwards deaf: {}\n", passed_s(), deaf.empty() ? "nobody" : deaf);
  } while (!deaf.empty() && passed_s() < timeout_s);
  EXPECT_EQ(deaf, "");
  EXPECT_EQ(stack.casualties(), "");
  EXPECT_THAT(implausible_counters(stack, flood_s + passed_s() + 10.0), testing::IsEmpty());
  constexpr std::size_t kMostSaid = 64 * 1024;
  for (const auto& [node, bytes] : stack.said())
    EXPECT_LT(bytes, kMostSaid + static_cast<std::size_t>(flood_s) * 4096) << node << " says too much";
  for (const auto& [node, code] : stack.stop()) EXPECT_EQ(code, 0) << node;
}

/// Says an event every 20 ms for so long, or until `enough`, asked after each; how many were heard.
int heard_events(bus::Writer<msg::KickReceipt>& writer, bus::Reader<msg::KickReceipt>& reader,
                 std::chrono::seconds longest, const std::function<bool(int in_a_row_unheard)>& enough) {
  const auto until = std::chrono::steady_clock::now() + longest;
  int received = 0, unheard = 0;
  static std::uint64_t seq = 0;
  do {
    msg::KickReceipt event{};
    event.robot_id = 1;
    event.seq = ++seq;
    writer.write(event);
    bus::renew_if_silent(reader);
    reader.wait(std::chrono::milliseconds{20});
    const auto now = static_cast<int>(reader.take([](const msg::KickReceipt&) {}));
    received += now;
    unheard = now > 0 ? 0 : unheard + 1;
  } while (!enough(unheard) && std::chrono::steady_clock::now() < until);
  return received;
}

TEST(MutatedPackets, ATopicWithoutAPeriodIsHeardAgainThoughNoOtherFellSilent) {
  const bus::LibraryLog unheard{[](bool, std::string_view) {}};
  const bus::WirePair pair = bus::fresh_wire_pair();
  const bus::Participant near{pair.a}, far{pair.b, bus::RealTime{}};
  bus::Writer<msg::KickReceipt> writer{near};
  bus::Reader<msg::KickReceipt> reader{far};
  ASSERT_TRUE(writer.wait_for_readers(1, std::chrono::seconds{30}));
  constexpr int kDeaf = 50;  // a second without a word, at least
  Mutations heartbeats;
  heartbeats.only = {submessage_named("HEARTBEAT")};
  heartbeats.discovery = false;
  heartbeats.from = 12;  // firstSN and lastSN
  heartbeats.to = 28;
  heartbeats.most_flips = 8;
  bool deaf = false;
  {
    const PacketMutator mutator{heartbeats};
    heard_events(writer, reader, std::chrono::seconds{60}, [&](int in_a_row) { return deaf = in_a_row >= kDeaf; });
  }
  ASSERT_TRUE(deaf) << "no packet broke it";
  EXPECT_GT(heard_events(writer, reader, std::chrono::seconds{30}, [](int in_a_row) { return in_a_row == 0; }), 0);
}

}  // namespace
}  // namespace trivela::faults

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (!testing::GTEST_FLAG(list_tests)) trivela::faults::enter_own_network();
  return RUN_ALL_TESTS();
}
