// `trivela match --devices emulated`: whole matches through an emulated referee box and emulated devices, an ioBoard
// alone, or a ReKick, drives and a gyro, beside the same match on the bus in lockstep. What the emulators log of
// themselves is the witness.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <regex>

#include "config/scenario/scenario.hpp"
#include "tests/e2e/log_rows.hpp"
#include "tests/e2e/program.hpp"
#include "tests/support/folder.hpp"

namespace trivela::e2e {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kPossessions = 3;  // of each of two halves

/// Nobody and nothing but the robot ends a possession, and it needs not turn far.
sim::Scenario undisturbed() {
  sim::Scenario world =
      config::load_scenario(std::filesystem::path{TRIVELA_SOURCE_DIR} / "config/scenarios/default.toml");
  world.opponent.distance_median_m = 30.0;
  world.opponent.distance_sigma_ln = 0.0;
  world.referee.stops_per_min = 0.0;
  world.possession.aim_error_sd_rad = 0.35;
  return world;
}

struct Pulse {
  std::int64_t t_ns = 0;
  double length_ms = 0.0;
};
struct SidedCommand {
  std::int64_t t_ns = 0;
  std::string word;
};
struct Kick {
  std::int64_t half = 0;
  std::int64_t possession_id = 0;
  double after_start_s = 0.0;
  double power = 0.0;
};

/// Each match of `text`, in its order.
std::vector<std::smatch> matches_of(const std::string& text, const std::string& pattern) {
  const std::regex regex{pattern};
  return {std::sregex_iterator{text.begin(), text.end(), regex}, std::sregex_iterator{}};
}

/// Devices that a match is played over.
struct Devices {
  std::string name;
  std::vector<std::string> settings;
  double power_ms = 0.0;       ///< of the pulse, for a unit of power
  double resolution_ms = 0.0;  ///< of a pulse
};

/// The ioBoard measures no charge; its model, which holds back a kick soon after another, is left out.
Devices ioboard() { return {"ioboard", {"hal.ioboard.charge_time_s=0"}, 0.128, 0.128}; }
Devices rekick_on_drives() {
  return {
      "rekick_cia402_mti", {"hal.kicker=\"rekick\"", "hal.wheels=\"cia402\"", "hal.gyro=\"mti\""}, 0.1 / 3.0, 0.001};
}

/// The matches, played once for all tests.
class EmulatedMatch : public testing::TestWithParam<Devices> {
 protected:
  struct Match {
    int code = 0;
    std::string said;
  };
  struct Played {
    tests::Folder folder;
    std::map<std::string, Match> matches;
  };

  static void SetUpTestSuite() {
    played_.emplace();
    std::ofstream{played_->folder / "undisturbed.toml"} << config::to_toml_text(undisturbed());
    play("simulated", {});
    for (const Devices& devices : {ioboard(), rekick_on_drives()}) {
      std::vector<std::string> words{"--devices", "emulated"};
      for (const std::string& setting : devices.settings) words.insert(words.end(), {"--set", setting});
      play(devices.name, words);
    }
  }
  static void TearDownTestSuite() { played_.reset(); }

  static void play(const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> words{"match", "--half", "stopped", "--half", "moving", "--minutes", "2", "--seed", "1"};
    for (const std::string& setting :
         {fmt::format("simulator.max_possessions={}", kPossessions), std::string{"run.scenario=\"undisturbed.toml\""}})
      words.insert(words.end(), {"--set", setting});
    words.insert(words.end(), {"--log-level", "info", "--out", name + ".db"});
    words.insert(words.end(), more.begin(), more.end());
    Program match{"trivela", words, played_->folder.path()};
    const int code = match.wait();
    played_->matches[name] = {code, match.errors()};
  }
  static const std::string& said() { return played_->matches.at(GetParam().name).said; }

  void SetUp() override {
    ASSERT_EQ(played_->matches.at("simulated").code, 0);
    ASSERT_EQ(played_->matches.at(GetParam().name).code, 0) << said();
  }

  static Reader log(const std::string& name) { return Reader{played_->folder / (name + ".db")}; }

  /// What the board has done.
  static std::vector<Pulse> pulses() {
    std::vector<Pulse> all;
    for (const auto& line : matches_of(said(), "pulse of ([0-9.]+) ms at ([0-9]+) ns"))
      all.push_back({std::stoll(line[2]), std::stod(line[1])});
    return all;
  }
  /// What the box has said.
  static std::vector<SidedCommand> words() {
    std::vector<SidedCommand> all;
    for (const auto& line : matches_of(said(), "([A-Z_]+) said by the box at ([0-9]+) ns"))
      all.push_back({std::stoll(line[2]), line[1]});
    return all;
  }

  static std::vector<Kick> kicks(const std::string& name) {
    std::vector<Kick> all;
    for (const Row& row :
         rows_of(log(name),
                 "SELECT k.half, k.possession_id, 1e-9 * (r.fired_t_ns - p.start_t_ns), r.power "
                 "FROM kick_truths AS k JOIN possession_truths AS p USING (session_id, robot_id, half, "
                 "possession_id) JOIN kick_receipts AS r USING (session_id, robot_id, kick_id) "
                 "WHERE r.accepted ORDER BY k.half, k.possession_id"))
      all.push_back({std::get<std::int64_t>(row[0]), std::get<std::int64_t>(row[1]), std::get<double>(row[2]),
                     std::get<double>(row[3])});
    return all;
  }

  static std::optional<Played> played_;
};
std::optional<EmulatedMatch::Played> EmulatedMatch::played_;

TEST_P(EmulatedMatch, EveryPossessionIsKickedAndItsTruthRecorded) {
  const Reader match = log(GetParam().name);
  EXPECT_EQ(number_of(match, "SELECT count(*) FROM possession_truths WHERE ending = 'kicked'"), 2 * kPossessions);
  EXPECT_EQ(kicks(GetParam().name).size(), std::size_t{2 * kPossessions}) << "a truth's kick is that of its receipt";
  EXPECT_EQ(number_of(match, "SELECT count(*) FROM kick_truths"), 2 * kPossessions);
  EXPECT_EQ(number_of(match, "SELECT count(*) FROM kick_outcomes"), 2 * kPossessions);
  EXPECT_EQ(number_of(match, "SELECT simulated FROM sessions"), 1);
  EXPECT_EQ(number_of(match, "SELECT count(*) FROM kicks WHERE (half = 1) <> (policy = 'stopped')"), 0)
      << "the halves are those of the box";
  EXPECT_THAT(losses_of(match), IsEmpty());
  EXPECT_THAT(loose_ends_of(played_->folder / (GetParam().name + ".db")), IsEmpty());
}

TEST_P(EmulatedMatch, EachPulseOfTheBoardHasOneAcceptedReceiptAndEachReceiptOnePulse) {
  const auto fired = pulses();
  const auto receipts =
      rows_of(log(GetParam().name),
              "SELECT fired_t_ns, power FROM kick_receipts AS r WHERE accepted AND NOT EXISTS (SELECT 1 "
              "FROM kick_receipts AS o WHERE o.kick_id = r.kick_id AND NOT o.accepted) "
              "ORDER BY fired_t_ns");
  ASSERT_EQ(fired.size(), receipts.size()) << said();
  ASSERT_GE(fired.size(), std::size_t{2 * kPossessions});
  constexpr std::int64_t kOldest_ns = 100'000'000;  // a shot that waited for longer is not sent
  for (std::size_t i = 0; i < fired.size(); ++i) {
    const auto fired_t_ns = std::get<std::int64_t>(receipts[i][0]);
    EXPECT_GE(fired[i].t_ns, fired_t_ns) << "no pulse before its instant";
    EXPECT_LT(fired[i].t_ns, fired_t_ns + kOldest_ns);
    EXPECT_NEAR(fired[i].length_ms, GetParam().power_ms * std::get<double>(receipts[i][1]),
                0.501 * GetParam().resolution_ms);
  }
}

// A STOP takes its way through the refbox node and the driver; an order that was judged before lives for
// kicker_driver.max_order_age_s.
TEST_P(EmulatedMatch, NothingIsKickedWhileTheBoxHasStoppedTheGame) {
  constexpr std::int64_t kOrderAge_ns = 100'000'000;
  const auto all = words();
  const auto count = [&](const std::string& word) { return std::ranges::count(all, word, &SidedCommand::word); };
  EXPECT_EQ(count("START"), 2 * kPossessions);
  EXPECT_EQ(count("STOP"), 2 * kPossessions + 1) << "and one at the end";
  EXPECT_EQ(count("SECOND_HALF"), 1);
  for (const Pulse& pulse : pulses()) {
    bool playing = false;
    for (const SidedCommand& word : all) {
      if (word.word == "START" && word.t_ns <= pulse.t_ns) playing = true;
      if (word.word == "STOP" && word.t_ns + kOrderAge_ns <= pulse.t_ns) playing = false;
    }
    EXPECT_TRUE(playing) << "pulse at " << pulse.t_ns << " ns";
  }
  EXPECT_EQ(number_of(log(GetParam().name), "SELECT max(goals_own) FROM referee"), count("GOAL"));
}

/// The middle one.
double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values.at(values.size() / 2);
}

// Possession for possession the same situation, noise included. On the bus START and samples come in one cycle and
// nothing takes time. Here START may reach the decision a cycle later, and what it orders takes its way. A busy machine
// may hold up any kick, so only the one that was least held up must come within two cycles.
TEST_P(EmulatedMatch, KicksAsOnTheBusButForTheDelayOfTheLines) {
  constexpr double kTwoCycles_s = 0.04;
  constexpr double kUnit = 1.0;  // set-points that one unit of the board's pulse is of
  const std::vector<Kick> on_the_bus = kicks("simulated");
  const std::vector<Kick> emulated = kicks(GetParam().name);
  ASSERT_EQ(on_the_bus.size(), std::size_t{2 * kPossessions});
  ASSERT_EQ(emulated.size(), on_the_bus.size());
  std::vector<double> later_s, more_power;
  for (std::size_t i = 0; i < emulated.size(); ++i) {
    ASSERT_EQ(emulated[i].half, on_the_bus[i].half);
    ASSERT_EQ(emulated[i].possession_id, on_the_bus[i].possession_id);
    later_s.push_back(std::abs(emulated[i].after_start_s - on_the_bus[i].after_start_s));
    more_power.push_back(std::abs(emulated[i].power - on_the_bus[i].power));
  }
  EXPECT_LE(std::ranges::min(later_s), kTwoCycles_s);
  EXPECT_LE(median(more_power), kUnit);
}

// Drives measure no turn rate: what stands there is the gyro's.
TEST_P(EmulatedMatch, TheGyrosTurnRateReachesOdometry) {
  const Reader match = log(GetParam().name);
  EXPECT_GT(number_of(match, "SELECT sum(gyro_radps IS NOT NULL) > 0.5 * count(*) FROM odometry"), 0);
  EXPECT_GT(number_of(match, "SELECT max(abs(gyro_radps)) > 0.5 FROM odometry"), 0) << "the robot has turned";
  EXPECT_GT(number_of(match, "SELECT avg(abs(gyro_radps - omega_radps)) < 0.1 FROM odometry"), 0);
}

INSTANTIATE_TEST_SUITE_P(Over, EmulatedMatch, testing::Values(ioboard(), rekick_on_drives()),
                         [](const auto& of) { return of.param.name; });

/// config/robots/lob_flat_1.toml with the lever's heights.
std::string lever_robot() {
  std::ifstream in{std::filesystem::path{TRIVELA_SOURCE_DIR} / "config/robots/lob_flat_1.toml"};
  std::string text, height = "120";
  for (std::string line; std::getline(in, line);) {
    text += line + "\n";
    if (!line.starts_with("exit_speeds_mps")) continue;
    std::string levers = height;
    for (int i = 1; i < 8; ++i) levers += ", " + height;
    text += "levers = [" + levers + "]\n";
    height = "20";
  }
  return text;
}

// The wish goes from the decision by the driver and the serial line to the board, whose lever the world's kicker obeys;
// the simulator's truth is the witness of which kick came out.
TEST(EmulatedMatchWithALever, EachOrderOfAFlatKickIsAFlatBallAndEachOfALobALob) {
  const tests::Folder folder;
  sim::Scenario world = undisturbed();
  world.keeper.enabled = world.kicker.flat.enabled = true;
  world.ball.sliding_friction_ratio = 0.3;
  std::ofstream{folder / "world.toml"} << config::to_toml_text(world);
  std::ofstream{folder / "robot.toml"} << lever_robot();
  Program match{"trivela",
                {"match",
                 "--half",
                 "predictive",
                 "--half",
                 "moving",
                 "--minutes",
                 "2",
                 "--seed",
                 "3",
                 "--devices",
                 "emulated",
                 "--set",
                 "run.scenario='world.toml'",
                 "--set",
                 "run.robot='robot.toml'",
                 "--set",
                 "simulator.max_possessions=4",
                 "--set",
                 "hal.ioboard.charge_time_s=0",
                 "--out",
                 "flat.db"},
                folder.path()};
  ASSERT_EQ(match.wait(), 0) << match.errors();
  const Reader log{folder / "flat.db"};
  const std::string kicked = "FROM kick_orders AS o JOIN kick_truths AS t USING (session_id, robot_id, kick_id) ";
  EXPECT_GE(number_of(log, "SELECT count(*) " + kicked + "WHERE o.kick_kind = 1"), 2);
  EXPECT_GE(number_of(log, "SELECT count(*) " + kicked + "WHERE o.kick_kind = 0"), 3);
  EXPECT_EQ(number_of(log, "SELECT count(*) " + kicked + "WHERE (o.kick_kind = 1) <> (t.release_vz_mps < 2.0)"), 0);
  EXPECT_EQ(number_of(log, "SELECT count(*) FROM kick_receipts WHERE refusal = 'lever'"), 0);
  EXPECT_GT(number_of(log, "SELECT count(*) FROM kicker_status WHERE lever_kind = 255"), 0) << "it moves";
  EXPECT_EQ(number_of(log, "SELECT count(*) FROM kicks WHERE outcome = 'unknown'"), 0);
}

TEST(EmulatedMatchUsage, ABoxHasNoWordsForAFifthHalf) {
  const tests::Folder folder;
  std::vector<std::string> words{"match", "--devices", "emulated", "--minutes", "0.01", "--out", "match.db"};
  for (int half = 0; half < 5; ++half) words.insert(words.end(), {"--half", "moving"});
  Program match{"trivela", words, folder.path()};
  EXPECT_EQ(match.wait(), 1);
  EXPECT_THAT(match.errors(), HasSubstr("simulator.halves = 5: a referee box has commands for 4"));
  EXPECT_THAT(match.errors(), HasSubstr("nothing was recorded"));
}

TEST(EmulatedMatchUsage, WhatTheFlagSaysIsNotSaidAgain) {
  const tests::Folder folder;
  Program match{"trivela", {"match", "--half", "moving", "--set", "simulator.devices=\"emulated\""}, folder.path()};
  EXPECT_EQ(match.wait(), 2);
  EXPECT_THAT(match.errors(), HasSubstr("--devices says it"));
}

}  // namespace
}  // namespace trivela::e2e
