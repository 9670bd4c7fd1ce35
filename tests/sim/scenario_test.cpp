#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string_view>

#include "sim/match.hpp"
#include "sim/scenario_fields.hpp"

namespace trivela::sim {
namespace {

TEST(Scenario, DefaultCanBePlayed) { EXPECT_FALSE(first_problem(Scenario{})); }

TEST(Scenario, NamesTheKeyAndTheValueThatIsImpossible) {
  const auto key_of = [](auto change) {
    Scenario s;
    change(s);
    const auto problem = first_problem(s);
    return problem ? problem->key : std::string{};
  };
  EXPECT_EQ(key_of([](Scenario& s) { s.ball.mass_kg = -1.0; }), "ball.mass_kg");
  EXPECT_EQ(key_of([](Scenario& s) { s.cycle_s = std::nan(""); }), "cycle_s");
  EXPECT_EQ(key_of([](Scenario& s) { s.possession.aim_error_sd_rad = 7.0; }), "possession.aim_error_sd_deg");
  EXPECT_EQ(key_of([](Scenario& s) { s.kicker.powers[1] = s.kicker.powers[0]; }), "kicker.powers");
  EXPECT_EQ(key_of([](Scenario& s) { s.kicker.powers = {15.0}; }), "kicker.powers");
  EXPECT_EQ(key_of([](Scenario& s) { s.kicker.exit_speeds_mps.pop_back(); }), "kicker.exit_speeds_mps");
  EXPECT_EQ(key_of([](Scenario& s) { s.kicker.exit_speeds_mps[3] = std::nan(""); }), "kicker.exit_speeds_mps");
  EXPECT_EQ(key_of([](Scenario& s) { s.kicker.exit_elevations_rad.clear(); }), "kicker.exit_elevations_rad");
  EXPECT_EQ(key_of([](Scenario& s) { s.possession.speed_min_mps = 3.0; }), "possession.speed_min_mps");
  EXPECT_EQ(key_of([](Scenario& s) { s.robot.wheel_angles_rad.resize(5); }), "robot.wheel_angles_rad");
  EXPECT_EQ(key_of([](Scenario& s) { s.opponent.count = 2.5; }), "opponent.count");
  EXPECT_EQ(key_of([](Scenario& s) {
              s.referee.set_pieces = true;
              s.possession.stop_s = 0.0;
            }),
            "referee.set_pieces");
  EXPECT_EQ(key_of([](Scenario& s) { s.opponent.count = 6.0; }), "opponent.count");
  EXPECT_EQ(key_of([](Scenario& s) { s.team.robots = 0.0; }), "team.robots");
  EXPECT_EQ(key_of([](Scenario& s) { s.team.speed_scale_ratios = {1.0, 1.0}; }), "team.speed_scale_ratios");
  EXPECT_NE(first_problem([] {
              Scenario s;
              s.ball.mass_kg = -1.5;
              return s;
            }())
                ->why.find("-1.5"),
            std::string::npos);
}

/// Counts what a visitor is shown.
struct Counter {
  std::multiset<std::string> keys;
  std::size_t bytes = 0;

  void operator()(std::string_view key, double&, Range) { keys.emplace(key), bytes += sizeof(double); }
  void operator()(std::string_view key, Degrees, Range) { keys.emplace(key), bytes += sizeof(double); }
  void operator()(std::string_view key, std::vector<double>& v, Range) { keys.emplace(key), bytes += sizeof v; }
  // A flag among doubles takes as much room as one.
  void operator()(std::string_view key, bool&) { keys.emplace(key), bytes += sizeof(double); }
  template <class T>
  void operator()(std::string_view, T& nested) {
    fields(*this, nested);
  }
};

TEST(Scenario, ListsEveryMemberWithItsUnit) {
  Scenario scenario;
  Counter seen;
  fields(seen, scenario);
  EXPECT_EQ(seen.bytes, sizeof(Scenario));  // nothing but doubles, flags and vectors: no member is left out
  const std::set<std::string_view> units{"m",   "s",  "mps",   "mps2",  "radps", "radps2",   "rad",
                                         "deg", "kg", "kgpm3", "ratio", "ln",    "distance", "all"};
  for (const auto& key : seen.keys) {
    if (key == "drag_coefficient" || key == "powers" || key == "recharge_per_s" || key == "enabled" || key == "count" ||
        key == "stops_per_min" || key == "opponents_half_only" || key == "robots" || key == "speed_scale_ratios" ||
        key == "drop_after_kicks" || key == "half_minutes" || key == "set_pieces")
      continue;
    EXPECT_TRUE(units.contains(std::string_view{key}.substr(key.rfind('_') + 1))) << key;
  }
}

TEST(Match, RefusesWhatCannotBePlayed) {
  Scenario bad;
  bad.ball.radius_m = 5.0;
  try {
    Match{bad, 1, 1, 1.0};
    FAIL() << "was accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "scenario: ball.radius_m: 5 is outside 0.02..0.25");
  }
  EXPECT_THROW((Match{Scenario{}, 1, 0, 1.0}), std::runtime_error);
  EXPECT_THROW((Match{Scenario{}, 1, 256, 1.0}), std::runtime_error);
  EXPECT_THROW((Match{Scenario{}, 1, 1, 0.0}), std::runtime_error);
  EXPECT_THROW((Match{Scenario{}, 1, 1, std::nan("")}), std::runtime_error);
}

}  // namespace
}  // namespace trivela::sim
