// Attackers beside a robot that plays: on a machine of their own on the team's network, and on the robot's loopback.
// By hand, longer: TRIVELA_TEAM_FLOOD_S. TRIVELA_TEAM_FLOOD_KEEP=FOLDER has the last packets where a node ended.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <signal.h>

#include <algorithm>
#include <functional>
#include <map>

#include "bus/domain/domain.hpp"
#include "bus/writer.hpp"
#include "config/team/team.hpp"
#include "idl/messages.hpp"
#include "tests/e2e/log_rows.hpp"
#include "tests/faults/air_flood.hpp"
#include "tests/faults/attackers.hpp"

namespace trivela::faults {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using std::chrono::seconds;
using Clock = std::chrono::steady_clock;

constexpr std::int64_t kS = 1'000'000'000;
const std::vector<std::string> kNodes{"trivela-odometry",      "trivela-world_state",   "trivela-kick_decision",
                                      "trivela-kicker_driver", "trivela-shot_observer", "trivela-recorder",
                                      "trivela-team_link"};

TEST_F(Attackers, OrdersForgedOnAnotherMachineReachARobotThatHasNoKeysFromItsOwnLoopbackAlone) {
  ASSERT_NO_FATAL_FAILURE(kick_off(false));
  const Packets forged = forged_orders(team->attacker(), config::TeamDomains{}.robot, team->tag(1));
  send(team->attacker(), "10.77.0.1", forged);
  EXPECT_EQ(received(), 0);
  EXPECT_TRUE(plays_on());
  send(team->host(1), "127.0.0.1", forged);
  EXPECT_GT(received(), 0) << "the packets are as good as a robot's own";
  EXPECT_EQ(team->casualties(), "");
  team->stop();
}

TEST_F(Attackers, OrdersForgedOnTheLoopbackOfARobotWithKeysAreHeardByNobody) {
  ASSERT_NO_FATAL_FAILURE(kick_off(true));
  const Packets forged = forged_orders(team->attacker(), config::TeamDomains{}.robot, team->tag(1));
  send(team->attacker(), "10.77.0.1", forged);
  send(team->host(1), "127.0.0.1", forged);
  EXPECT_EQ(received(), 0);
  EXPECT_TRUE(plays_on());
  EXPECT_EQ(team->casualties(), "");
  team->stop();
}

/// Resident memory of a process, sampled while it is flooded.
struct Memory {
  std::vector<std::int64_t> bytes;

  std::int64_t most(std::size_t from, std::size_t to) const {
    return *std::max_element(bytes.begin() + static_cast<std::ptrdiff_t>(from),
                             bytes.begin() + static_cast<std::ptrdiff_t>(to));
  }
  /// In MB, the greatest of each tenth of the flood.
  std::string course() const {
    std::string text;
    for (std::size_t tenth = 0; tenth < 10; ++tenth) {
      const std::size_t from = bytes.size() * tenth / 10, to = bytes.size() * (tenth + 1) / 10;
      if (from < to) text += fmt::format(" {}", most(from, to) >> 20);
    }
    return text;
  }
  /// Whether all that was added is little, and the second half of a long flood added less still: what is invented is
  /// forgotten after its lease of ten seconds, so that a shorter one cannot show where it ends.
  bool stays(milliseconds flood) const {
    constexpr std::int64_t kMost = std::int64_t{64} << 20, kLittle = std::int64_t{8} << 20;
    const std::size_t half = bytes.size() / 2;
    const std::int64_t first = most(0, half) - bytes.front(), second = most(half, bytes.size()) - most(0, half);
    return first + std::max(second, std::int64_t{0}) < kMost && (flood < kLong || second < kLittle);
  }
  static constexpr milliseconds kLong{60'000};
};

milliseconds flood_length() {
  return milliseconds{static_cast<std::int64_t>(by_hand("TRIVELA_TEAM_FLOOD_S", 10) * 1e3)};
}

/// Five times a second for the length of a flood.
void during_flood(const TeamOnAir& team, const std::function<void()>& look) {
  for (const auto end = Clock::now() + flood_length(); Clock::now() < end;) {
    team.pass(milliseconds{200});
    look();
  }
}

TEST_F(Attackers, AFloodOnTheLoopbackOfARobotWithKeysNeitherGrowsItsNodesNorOrdersAKick) {
  ASSERT_NO_FATAL_FAILURE(kick_off(true));
  Wiretap tap{team->host(1)};
  team->pass(seconds{3});
  std::map<std::string, Memory> memory;
  {
    const AirFlood flood{team->host(1), {"127.0.0.1"}, config::TeamDomains{}.robot, 10, tap.take(), 1};
    during_flood(*team, [&] {
      for (const std::string& node : kNodes) memory[node].bytes.push_back(resident_bytes(team->process(1, node).pid()));
    });
    fmt::print("{} packets\n", flood.sent());
    EXPECT_GT(flood.sent(), 1000u);
  }
  for (const auto& [node, samples] : memory) {
    fmt::print("{}: MB by tenth of the flood{}\n", node, samples.course());
    EXPECT_TRUE(samples.stays(flood_length())) << node;
  }
  EXPECT_EQ(team->casualties(), "");
  EXPECT_TRUE(plays_on());
  team->stop();
  EXPECT_EQ(rows("kick_orders WHERE kick_id NOT IN (SELECT kick_id FROM kick_decisions)"), 0);
  EXPECT_EQ(rows("(SELECT kick_id FROM kick_receipts WHERE accepted = 1 GROUP BY kick_id HAVING count(*) > 1)"), 0)
      << "an order said again was fired again";
}

TEST_F(Attackers, WhoHasNoIdentityOfTheTeamIsHeardByNobodyOnItsNetwork) {
  ASSERT_NO_FATAL_FAILURE(start_team());
  const security::TeamKeys others;
  others.keys().issue(0, {"team_link"}, security::days_from(security::this_second(), 9));
  // What each has besides: the team's own configuration.
  const bus::DomainConfig plain = bus::from_file(config::TeamDomains{}.team, folder / "machine_1" / "team_bus.xml");
  const std::map<std::string, bus::DomainConfig> attackers{
      {"nobody's", plain},
      {"another team's base", bus::secured(plain, others.robot(0) / "team", "team_bus")},
      {"a robot's own team_link, by its identity of the robot's bus", bus::secured(plain, keys.robot(1), "team_link")}};
  for (const auto& attacker : attackers)
    on_host(team->attacker(), [&] {
      bus::Writer<msg::Referee> forged{bus::Participant{attacker.second}};
      for (int time = 0; time < 30; ++time) {
        msg::Referee word{};
        word.command_counter = 666;
        word.robot_id = 0;
        forged.write(word);
        team->pass(milliseconds{100});
      }
      EXPECT_EQ(forged.readers(), 0u) << attacker.first;
    });
  EXPECT_EQ(rows("referee WHERE command_counter = 666"), 0);
  EXPECT_EQ(team->casualties(), "");
  team->stop();
}

/// A secured team whose links are started by the launcher, and what became of them.
class LaunchedLinks {
 public:
  explicit LaunchedLinks(TeamOnAir& team) : team_(team) {
    for (std::size_t machine = 0; machine < links_.size(); ++machine) links_[machine] = team_.link(machine);
  }

  /// Notes those that ended, with what the flood sent last, and those that are back.
  void look(const AirFlood* flood) {
    for (std::size_t machine = 0; machine < links_.size(); ++machine) {
      const int now = team_.link(machine);
      if (now == links_[machine] || now == 0) continue;
      ++ended;
      if (const char* const keep = std::getenv("TRIVELA_TEAM_FLOOD_KEEP"); keep != nullptr && flood != nullptr)
        keep_packets(fs::path{keep} / fmt::format("flood_{}.txt", ended),
                     fmt::format("machine {}\n{}", machine, team_.said(machine, "team_link")), flood->last());
      links_[machine] = now;
    }
  }

  /// The most that a link has of the memory.
  std::int64_t most_bytes() const {
    std::int64_t most = 0;
    for (const int pid : links_) most = std::max(most, resident_bytes(pid));
    return most;
  }

  /// Ends the link as a crash does; how long it takes the launcher until it runs again.
  milliseconds back_after_crash(std::size_t machine) {
    const auto began = Clock::now();
    kill(links_[machine], SIGSEGV);
    if (!team_.wait_for(kAirTimeout, [&] {
          const int now = team_.link(machine);
          return now != 0 && now != links_[machine];
        }))
      return milliseconds::max();
    links_[machine] = team_.link(machine);
    return std::chrono::duration_cast<milliseconds>(Clock::now() - began);
  }

  int of(std::size_t machine) const { return links_[machine]; }
  int ended = 0;

 private:
  TeamOnAir& team_;
  std::array<int, 3> links_{};
};

TEST_F(Attackers, AFloodFromAnotherMachineChangesNoWordOfASecuredTeamAndALinkThatEndsIsBackWithinTwoSeconds) {
  ASSERT_NO_FATAL_FAILURE(start_team());
  const auto words = [&](const std::string& where) { return rows("referee WHERE " + where); };
  const std::int64_t before = number_in(team->logs(1), "SELECT max(t_ns) FROM referee");
  LaunchedLinks links{*team};
  std::map<int, Memory> memory;  // by process
  {
    const AirFlood flood{team->attacker(),           {"10.77.0.100", "10.77.0.1", "10.77.0.2", "224.16.32.39"},
                         config::TeamDomains{}.team, 1,
                         team->hub().overheard(),    1};
    during_flood(*team, [&] {
      links.look(&flood);
      memory[links.of(1)].bytes.push_back(resident_bytes(links.of(1)));
    });
    fmt::print("{} packets; team_link ended {} times\n", flood.sent(), links.ended);
    EXPECT_GT(flood.sent(), 1000u);
  }
  const Memory& longest =
      std::ranges::max_element(memory, {}, [](const auto& of) { return of.second.bytes.size(); })->second;
  fmt::print("robot 1's longest, {} s: MB by tenth of it{}\n", longest.bytes.size() / 5, longest.course());
  EXPECT_TRUE(longest.stays(longest.bytes.size() * milliseconds{200}));
  EXPECT_LT(links.back_after_crash(1), seconds{2});
  const std::int64_t after = number_in(team->logs(1), "SELECT max(t_ns) FROM referee");
  EXPECT_TRUE(team->wait_for(kAirTimeout, [&] {
    links.look(nullptr);
    return words(fmt::format("playing = 1 AND t_ns > {}", after + 2 * kS)) > 10;
  })) << team->said(1, "team_link");
  EXPECT_EQ(words(fmt::format("playing = 0 AND t_ns > {}", before)), 0) << "a word from before the START came again";
  EXPECT_EQ(words(fmt::format(
                "command_counter <> (SELECT command_counter FROM referee WHERE t_ns = {0}) AND t_ns > {0}", before)),
            0);
  EXPECT_EQ(rows("kick_orders") + rows("kick_receipts"), 0) << "nothing fires";
  EXPECT_EQ(team->casualties(), "");
  team->stop();
}

/// By hand, after 100 s, the unknown participants' handshakes run out, which can break the library's
/// (nodes/runtime/flood_watch.hpp).
TEST_F(Attackers, ParticipantsThatWantToBeRememberedForEverGetNoMoreOfTheMemoryThanALinkMayTakeAndItIsBack) {
  const bool long_one = flood_length() > seconds{10};
  const std::int64_t limit_mb = long_one ? 1024 : 48;
  ASSERT_NO_FATAL_FAILURE(start_team(true, {fmt::format("run.memory_limit_mb={}", limit_mb)}));
  LaunchedLinks links{*team};
  std::int64_t most = 0;
  {
    const AirFlood flood{team->attacker(),           {"10.77.0.100", "10.77.0.1", "10.77.0.2", "224.16.32.39"},
                         config::TeamDomains{}.team, 1,
                         team->hub().overheard(),    1,
                         AirFlood::kUndying};
    const auto look = [&] {
      links.look(&flood);
      most = std::max(most, links.most_bytes());
    };
    if (long_one) {
      during_flood(*team, look);
    } else {
      EXPECT_TRUE(team->wait_for(kAirTimeout, [&] {
        look();
        return links.ended > 0;
      })) << "nothing grew";
    }
    fmt::print("{} packets; team_link ended {} times; at most {} MB\n", flood.sent(), links.ended, most >> 20);
  }
  EXPECT_LT(most >> 20, 3 * limit_mb) << "it is looked once a second, and by force where it is twice the limit";
  std::string said;
  for (const std::size_t machine : {0u, 1u, 2u}) said += team->said(machine, "team_link");
  if (!long_one) {
    EXPECT_THAT(said, testing::HasSubstr("more than run.memory_limit_mb = 48: ends, to be started again"));
  }
  for (const std::size_t robot : {1u, 2u}) {  // who starts again is let in
    links.back_after_crash(robot);
    const std::int64_t after = number_in(team->logs(robot), "SELECT max(t_ns) FROM referee");
    const std::string words =
        fmt::format("SELECT count(*) FROM referee WHERE playing = 1 AND t_ns > {}", after + 2 * kS);
    EXPECT_TRUE(team->wait_for(kAirTimeout, [&] { return number_in(team->logs(robot), words) > 10; }))
        << robot << ": " << said;
  }
  EXPECT_EQ(team->casualties(), "");
  team->stop();
}

}  // namespace
}  // namespace trivela::faults
