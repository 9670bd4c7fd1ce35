// A team of robots and a base, each a host of its own, over an air that loses, delays and reorders: what becomes of the
// referee's word, of the clocks and of the record. More of it by hand: TRIVELA_TEAM_ROBOTS, TRIVELA_TEAM_OUTAGE_S;
// TRIVELA_TEAM_PEERS=1: without a group.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <signal.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <set>

#include "tests/e2e/log_rows.hpp"
#include "tests/e2e/program.hpp"
#include "tests/faults/air_meter.hpp"
#include "tests/faults/air_test.hpp"
#include "tests/faults/kick_witness.hpp"
#include "tests/faults/team_on_air.hpp"
#include "tests/security/key_fixture.hpp"

namespace trivela::faults {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::AllOf;
using testing::Ge;
using testing::HasSubstr;
using testing::Le;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kS = 1'000'000'000;
const Way kAir{.delay = milliseconds{1}, .jitter = milliseconds{20}, .drop = 0.1};
constexpr seconds kTimeout = kAirTimeout;

/// `trivela` with these arguments, in the folder; what it said goes to `said`.
int trivela(const fs::path& folder, std::vector<std::string> arguments, std::string& said) {
  e2e::Program program{"trivela", std::move(arguments), folder};
  const int code = program.wait();
  said = program.output() + program.errors();
  return code;
}

class TeamOnAirTest : public AirTest {};

/// How far UTC by the sessions' clocks differs between machines whose clocks are ahead by so much.
std::int64_t spread_of_clocks(const e2e::Reader& merged, const std::vector<std::int64_t>& ahead_ns) {
  std::int64_t least = INT64_MAX, greatest = INT64_MIN;
  for (std::size_t machine = 0; machine < ahead_ns.size(); ++machine) {
    const auto rows = e2e::rows_of(
        merged, fmt::format("SELECT c.utc_offset_ns FROM session_clocks AS c WHERE c.session_id IN (SELECT DISTINCT "
                            "session_id FROM clock_offsets WHERE robot_id = {})",
                            machine));
    EXPECT_FALSE(rows.empty()) << "machine " << machine << " is not aligned";
    for (const auto& row : rows) {
      const std::int64_t utc_ns = std::get<std::int64_t>(row[0]) + ahead_ns[machine];
      least = std::min(least, utc_ns);
      greatest = std::max(greatest, utc_ns);
    }
  }
  return greatest - least;
}

/// The longest silence of a stream in a log, in seconds.
double longest_silence_s(const e2e::Reader& log, const std::string& stream) {
  return e2e::real_of(log, fmt::format("SELECT max(1e-9 * (to_t_ns - from_t_ns)) FROM losses WHERE stream = '{}' AND "
                                       "robot_id > 0",
                                       stream));
}

TEST_F(TeamOnAirTest, ARobotWhoseRefereeCrossesTheNetworkStandsInItsSilenceAndPlaysOnAndTheMergedLogSaysSo) {
  const double outage_s = std::max(2.0, by_hand("TRIVELA_TEAM_OUTAGE_S", 2.0));
  TeamPlan plan = this->plan();
  plan.robots = {Plays::kTeamReferee, Plays::kNothing};
  for (auto more = by_hand("TRIVELA_TEAM_ROBOTS", 2); more > 2; --more)
    plan.robots.push_back(plan.robots.size() % 2 == 0 ? Plays::kTeamReferee : Plays::kOwnReferee);
  for (std::size_t machine = 0; machine <= plan.robots.size(); ++machine)
    plan.ahead_ns.push_back(static_cast<std::int64_t>(machine) * 50 * kMs);
  TeamOnAir team{plan};
  team.air(kAir);
  std::vector<std::unique_ptr<KickWitness>> witnesses;
  for (std::uint32_t robot = 1; robot <= plan.robots.size(); ++robot)
    witnesses.push_back(std::make_unique<KickWitness>(team.host(robot), robot, team.tag(robot)));
  team.start();
  const auto one = [&] { return team.logs(1); };
  ASSERT_TRUE(team.wait_for(kTimeout, [&] { return cycles(one(), true, 0) > 100; }))
      << "never played: " << team.casualties() << team.said(1, "trivela-team_link") << team.said(0, "trivela-team_link")
      << team.said(0, "trivela-refbox");
  for (const std::size_t machine : {0u, 1u, 2u})
    ASSERT_TRUE(team.wait_for(
        kTimeout, [&] { return number_in(team.logs(machine), "SELECT count(*) FROM clock_offsets") >= 10; }));

  // Something is gone for so long: the robot stands; it comes back: the robot plays on.
  const auto without = [&](const char* what, double length_s, const std::function<void()>& lose,
                           const std::function<void()>& give) {
    const std::int64_t before = last_instant(one());
    lose();
    team.pass(milliseconds{static_cast<std::int64_t>(length_s * 1e3)});
    EXPECT_TRUE(team.wait_for(kTimeout, [&] { return cycles(one(), false, before) > 20; })) << what << ": it went on";
    const std::int64_t stood = last_instant(one());
    give();
    EXPECT_TRUE(team.wait_for(kTimeout, [&] { return cycles(one(), true, stood) > 50; })) << what << " is back";
    EXPECT_EQ(team.casualties(), "") << what;
  };
  const auto sound_again = [&] { team.air(kAir); };
  without(
      "the base", 2.0, [&] { team.cut(0); }, sound_again);
  if (outage_s > 2.0)
    without(
        "the base, for long", outage_s, [&] { team.cut(0); }, sound_again);
  without(
      "the address", 0.0, [&] { team.lose_address(1); }, [&] { team.give_address(1); });
  EXPECT_THAT(team.said(1, "trivela-team_link"), HasSubstr("has lost its address: leaves the team's bus"));
  without(
      "the interface", 0.0, [&] { team.lose_interface(1); }, [&] { team.give_interface(1); });

  // The robot that plays is started again, but for its world and its record, as a robot does whose computer is quick.
  const std::int64_t as_before = last_instant(one());
  for (const std::string& node : kChain) team.process(1, node).signal(SIGKILL);
  for (const std::string& node : kChain) team.restart(1, node);
  EXPECT_TRUE(team.wait_for(kTimeout, [&] { return cycles(one(), true, as_before) > 50; })) << "started again";

  // Another is started again, its recorder late.
  for (const char* const node : {"trivela-team_link", "trivela-recorder"}) team.process(2, node).signal(SIGKILL);
  team.restart(2, "trivela-team_link");
  team.pass(milliseconds{500});
  team.restart(2, "trivela-recorder");
  ASSERT_TRUE(team.wait_for(kTimeout, [&] {
    return team.logs(2).size() == 2 && number_in(team.logs(2), "SELECT count(*) FROM clock_offsets") >= 10;
  })) << team.said(2, "trivela-team_link");
  EXPECT_EQ(team.casualties(), "");
  std::set<std::int64_t> kicked;
  for (const auto& witness : witnesses) kicked.insert(witness->kicks().begin(), witness->kicks().end());
  team.stop();

  // The robot stood within 1.1 s of the last word, in every outage. A word counts 0.2 s before its instant, since a
  // cycle is stamped by its sensors, which come before it.
  const e2e::Reader log{one().back()};
  const double played_on_s = e2e::real_of(log, R"(
    SELECT max(1e-9 * (w.t_ns - (SELECT max(r.t_ns) FROM referee AS r WHERE r.t_ns <= w.t_ns + 200000000)))
    FROM world_states AS w WHERE w.playing = 1)");
  EXPECT_LT(played_on_s, 1.1);
  EXPECT_GE(longest_silence_s(log, "referee"), outage_s * 0.9);
  EXPECT_GE(longest_silence_s(log, "team_state of the base"), outage_s * 0.9);
  EXPECT_EQ(e2e::number_of(log,
                           "SELECT count(*) FROM kick_orders AS o JOIN world_states AS w ON w.t_ns = o.t_ns WHERE "
                           "w.playing = 0"),
            0);

  std::vector<std::string> arguments{"merge", "merged.db"};
  std::int64_t truths = 0, decisions = 0;
  for (std::size_t machine = 0; machine <= plan.robots.size(); ++machine)
    for (const fs::path& file : team.logs(machine)) {
      arguments.push_back(file.string());
      truths += number_in({file}, "SELECT count(*) FROM kick_truths");
      decisions += number_in({file}, "SELECT count(*) FROM kick_decisions");
    }
  std::string said;
  constexpr int kWithLoss = 3;  // the killed recorder's session, and the silences
  EXPECT_EQ(trivela(folder.path(), arguments, said), kWithLoss) << said;
  EXPECT_THAT(said, HasSubstr("of robot 2 was never closed"));
  EXPECT_THAT(said, HasSubstr(" silent from "));
  fmt::print("{}", said);
  const e2e::Reader merged{folder / "merged.db"};
  EXPECT_GE(longest_silence_s(merged, "referee"), outage_s * 0.9);
  EXPECT_EQ(e2e::number_of(merged, "SELECT count(*) FROM kick_truths"), truths);
  EXPECT_EQ(e2e::number_of(merged, "SELECT count(*) FROM kick_decisions"), decisions);
  EXPECT_EQ(e2e::number_of(merged,
                           "SELECT count(*) FROM kick_truths WHERE kick_id NOT IN (SELECT kick_id FROM "
                           "kick_receipts WHERE accepted = 1)"),
            0)
      << "what was kicked was ordered";
  EXPECT_EQ(e2e::number_of(merged, "SELECT count(*) - count(DISTINCT kick_id) FROM kick_truths"), 0);
  EXPECT_EQ(e2e::number_of(merged, "SELECT count(*) - count(DISTINCT kick_id) FROM kick_receipts WHERE accepted = 1"),
            0);
  EXPECT_FALSE(kicked.empty());
  std::set<std::int64_t> in_the_log;
  for (const auto& row : e2e::rows_of(merged, "SELECT kick_id FROM kick_truths"))
    in_the_log.insert(std::get<std::int64_t>(row[0]));
  EXPECT_THAT(in_the_log, testing::IsSupersetOf(kicked)) << "what was kicked, by the simulators themselves";
  EXPECT_LT(spread_of_clocks(merged, plan.ahead_ns), 5 * kMs);
  const auto offsets = e2e::rows_of(merged, "SELECT robot_id, other_robot_id, offset_ns, error_ns FROM clock_offsets");
  for (const auto& row : offsets) {
    const auto of = [&](std::size_t column) { return std::get<std::int64_t>(row[column]); };
    const std::int64_t truth =
        plan.ahead_ns.at(static_cast<std::size_t>(of(1))) - plan.ahead_ns.at(static_cast<std::size_t>(of(0)));
    EXPECT_LE(std::abs(of(2) - truth), of(3)) << "robot " << of(0) << " of " << of(1);
  }
}

/// What five robots and a base send, by the second.
struct Traffic {
  AirMeter meter;
  double length_s;

  double bps() const { return meter.ethernet_bytes() * 8 / length_s; }
  double frames_hz(AirKind kind) const { return meter.of(kind).frames / length_s; }
};

/// Ten seconds of it, once everybody knows everybody; printed.
Traffic traffic_of(TeamPlan plan) {
  plan.robots.assign(5, Plays::kNothing);
  TeamOnAir team{plan};
  team.start();
  for (std::size_t machine = 0; machine <= 5; ++machine)
    EXPECT_TRUE(team.wait_for(
        kTimeout,
        [&] { return number_in(team.logs(machine), "SELECT count(DISTINCT other_robot_id) FROM clock_offsets") == 5; }))
        << "machine " << machine << ": " << team.said(machine, "trivela-team_link");
  const AirMeter before = team.hub().meter();
  const auto began = std::chrono::steady_clock::now();
  team.pass(seconds{10});
  const double length_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  const Traffic traffic{team.hub().meter() - before, length_s};
  fmt::print("{}", air_table(traffic.meter, length_s));
  team.stop();
  return traffic;
}

TEST_F(TeamOnAirTest, FiveRobotsAndABaseTakeLessThanAMegabitASecond) {
  TeamPlan plan = this->plan();
  plan.by_group = by_hand("TRIVELA_TEAM_PEERS", 0) == 0;
  const Traffic traffic = traffic_of(plan);
  EXPECT_LT(traffic.bps(), 1e6);
  EXPECT_GT(traffic.frames_hz(AirKind::kTeamState), 100) << "175 where the machine keeps up";
  EXPECT_GT(traffic.frames_hz(AirKind::kReferee), 30) << "5 ways";
  EXPECT_LE(traffic.meter.longest, 1400 + 42) << "no message is cut";
}

TEST_F(TeamOnAirTest, FiveRobotsAndABaseWithKeysTakeLessThanAMegabitASecond) {
  const security::TeamKeys keys;
  const auto week = security::days_from(security::this_second(), 9);
  for (std::uint32_t machine = 0; machine <= 5; ++machine)
    keys.keys().issue(machine, security::usual_nodes(machine), week);
  TeamPlan plan = this->plan();
  plan.keys = keys.keys().path();
  const Traffic traffic = traffic_of(plan);
  EXPECT_LT(traffic.bps(), 1e6);
  EXPECT_GT(traffic.frames_hz(AirKind::kTeamState), 100);
  EXPECT_GT(traffic.frames_hz(AirKind::kReferee), 30);
}

}  // namespace
}  // namespace trivela::faults
