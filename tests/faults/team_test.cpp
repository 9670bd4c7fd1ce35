// A team of robots and a base, each a host of its own, over an air that loses, delays and reorders: what becomes of the
// referee's word, of the clocks and of the record. More of it by hand: TRIVELA_TEAM_ROBOTS, TRIVELA_TEAM_OUTAGE_S;
// TRIVELA_TEAM_PEERS=1: without a group.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <signal.h>

#include <cmath>

#include "tests/e2e/log_rows.hpp"
#include "tests/e2e/program.hpp"
#include "tests/faults/air_meter.hpp"
#include "tests/faults/air_test.hpp"
#include "tests/faults/team_on_air.hpp"

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
constexpr seconds kPatience = kAirPatience;

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
  const double outage_s = by_hand("TRIVELA_TEAM_OUTAGE_S", 3.0);
  TeamPlan plan = this->plan();
  plan.robots = {Plays::kTeamReferee, Plays::kNothing};
  for (auto more = by_hand("TRIVELA_TEAM_ROBOTS", 2); more > 2; --more)
    plan.robots.push_back(more > 4 ? Plays::kTeamReferee : Plays::kOwnReferee);
  for (std::size_t machine = 0; machine <= plan.robots.size(); ++machine)
    plan.ahead_ns.push_back(static_cast<std::int64_t>(machine) * 50 * kMs);
  TeamOnAir team{plan};
  team.air(kAir);
  team.start();
  const auto one = [&] { return team.logs(1); };
  ASSERT_TRUE(team.wait_for(kPatience, [&] { return cycles(one(), true, 0) > 100; }))
      << "never played: " << team.casualties() << team.said(1, "trivela-team_link") << team.said(0, "trivela-team_link")
      << team.said(0, "trivela-refbox");
  for (const std::size_t machine : {0u, 1u, 2u})
    ASSERT_TRUE(team.wait_for(
        kPatience, [&] { return number_in(team.logs(machine), "SELECT count(*) FROM clock_offsets") >= 10; }));

  // The base is gone.
  const std::int64_t before = last_instant(one());
  team.cut(0);
  team.pass(milliseconds{static_cast<std::int64_t>(outage_s * 1e3)});
  ASSERT_TRUE(team.wait_for(kPatience, [&] { return cycles(one(), false, before) > 20; })) << "it went on";
  const std::int64_t stood = last_instant(one());
  team.air(kAir);
  ASSERT_TRUE(team.wait_for(kPatience, [&] { return cycles(one(), true, stood) > 50; })) << "it never played on";
  EXPECT_EQ(team.casualties(), "");

  // The robot's address is gone, and comes back.
  const std::int64_t with_address = last_instant(one());
  team.lose_address(1);
  ASSERT_TRUE(team.wait_for(kPatience, [&] { return cycles(one(), false, with_address) > 20; }));
  const std::int64_t without = last_instant(one());
  team.give_address(1);
  ASSERT_TRUE(team.wait_for(kPatience, [&] { return cycles(one(), true, without) > 50; })) << "its address is back";
  EXPECT_THAT(team.said(1, "trivela-team_link"), HasSubstr("has lost its address: leaves the team's bus"));

  // A robot is started anew, its recorder late.
  for (const char* const node : {"trivela-team_link", "trivela-recorder"}) team.process(2, node).signal(SIGKILL);
  team.restart(2, "trivela-team_link");
  team.pass(milliseconds{500});
  team.restart(2, "trivela-recorder");
  ASSERT_TRUE(team.wait_for(kPatience, [&] {
    return team.logs(2).size() == 2 && number_in(team.logs(2), "SELECT count(*) FROM clock_offsets") >= 10;
  })) << team.said(2, "trivela-team_link");
  EXPECT_EQ(team.casualties(), "");
  team.stop();

  // The robot stood within 1.3 s of the last word, in every outage.
  const e2e::Reader log{one().back()};
  const double played_on_s = e2e::real_of(log, R"(
    SELECT max(1e-9 * (w.t_ns - (SELECT max(r.t_ns) FROM referee AS r WHERE r.t_ns <= w.t_ns)))
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
  EXPECT_LT(spread_of_clocks(merged, plan.ahead_ns), 5 * kMs);
  const auto offsets = e2e::rows_of(merged, "SELECT robot_id, other_robot_id, offset_ns, error_ns FROM clock_offsets");
  for (const auto& row : offsets) {
    const auto of = [&](std::size_t column) { return std::get<std::int64_t>(row[column]); };
    const std::int64_t truth =
        plan.ahead_ns.at(static_cast<std::size_t>(of(1))) - plan.ahead_ns.at(static_cast<std::size_t>(of(0)));
    EXPECT_LE(std::abs(of(2) - truth), of(3)) << "robot " << of(0) << " of " << of(1);
  }
}

/// The rows of a lockstep run's decisions, but for session and kick.
std::vector<std::string> decisions_of(const fs::path& file) {
  std::vector<std::string> rows;
  const e2e::Reader log{file};
  for (const auto& row : e2e::rows_of(log, "SELECT * FROM kick_decisions ORDER BY seq")) {
    std::string text;
    for (std::size_t column = 1; column < row.size(); ++column)
      std::visit(
          [&]<class T>(const T& cell) {
            if constexpr (std::is_same_v<T, std::string>) text += cell + "|";
            if constexpr (std::is_same_v<T, double>) text += fmt::format("{:a}|", cell);
            if constexpr (std::is_same_v<T, std::int64_t>)
              text += cell > (std::int64_t{1} << 40) && text.find('|') != std::string::npos && column == 4
                          ? "kick|"
                          : fmt::format("{}|", cell);
          },
          row[column]);
    rows.push_back(text);
  }
  return rows;
}

TEST_F(TeamOnAirTest, ARobotWithItsOwnRefereeDecidesTheSameToTheBitWhateverTheNetworkDoes) {
  std::vector<std::vector<std::string>> played;
  for (const bool disturbed : {false, true}) {
    const e2e::Folder own;
    TeamPlan plan = this->plan();
    plan.folder = own.path();
    plan.robots = {Plays::kInLockstep};
    TeamOnAir team{plan};
    if (disturbed) team.air({.jitter = milliseconds{20}, .drop = 0.3});
    team.start();
    bool there = true;
    ASSERT_TRUE(team.wait_for(seconds{300}, [&] {
      if (disturbed) (there = !there) ? team.give_address(1) : team.lose_address(1);
      return team.process(1, "trivela-simulator").ended();
    })) << team.said(1, "trivela-simulator");
    EXPECT_EQ(team.process(1, "trivela-simulator").code(), 0) << team.said(1, "trivela-simulator");
    team.stop();
    ASSERT_EQ(team.logs(1).size(), 1u);
    played.push_back(decisions_of(team.logs(1).front()));
  }
  EXPECT_GT(played[0].size(), 100u);
  EXPECT_EQ(played[0], played[1]);
}

TEST_F(TeamOnAirTest, FiveRobotsAndABaseTakeLessThanAMegabitASecond) {
  TeamPlan plan = this->plan();
  plan.robots.assign(5, Plays::kNothing);
  plan.by_group = by_hand("TRIVELA_TEAM_PEERS", 0) == 0;
  TeamOnAir team{plan};
  team.start();
  for (std::size_t machine = 0; machine <= 5; ++machine)
    ASSERT_TRUE(team.wait_for(
        kPatience,
        [&] { return number_in(team.logs(machine), "SELECT count(DISTINCT other_robot_id) FROM clock_offsets") == 5; }))
        << "machine " << machine << ": " << team.said(machine, "trivela-team_link");
  const AirMeter before = team.hub().meter();
  const auto began = std::chrono::steady_clock::now();
  team.pass(seconds{10});
  const double length_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  const AirMeter air = team.hub().meter() - before;
  fmt::print("{}", air_table(air, length_s));
  EXPECT_LT(air.bytes() * 8 / length_s, 1e6);
  EXPECT_GT(air.of(AirKind::kTeamState).frames / length_s, 100)
      << "30 ways, ten times a second where the machine keeps up";
  EXPECT_GT(air.of(AirKind::kReferee).frames / length_s, 30) << "5 ways";
  EXPECT_LE(air.longest, 1400 + 42) << "no message is cut";
  team.stop();
}

}  // namespace
}  // namespace trivela::faults
