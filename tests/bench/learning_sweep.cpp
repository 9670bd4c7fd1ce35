// What a robot that learns its kicker gains, by how many kicks it has made. Simulated; the outcomes counted are the
// simulator's truth, which no robot hears.
//     build/release/tests/learning_sweep [--robots 50] [--matches 4] [--seed 1] [--jobs 2]
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <functional>
#include <numbers>

#include "config/robot.hpp"
#include "config/text/installation.hpp"
#include "experiment/calibration/simulated_calibration.hpp"
#include "experiment/play/play_match.hpp"
#include "experiment/run/arms.hpp"
#include "experiment/run/in_threads.hpp"
#include "experiment/study/effects.hpp"
#include "kicking/random/draws.hpp"

namespace {

using namespace trivela;
using config::SelfCalibrationMode;
using experiment::ArmTally;

/// Kicks that a robot has made before an opportunity.
struct Band {
  int from = 0, to = 0;
  const char* name = "";
};
constexpr std::array kBands{Band{0, 14, "kicks 1 to 15"}, Band{15, 39, "16 to 40"}, Band{40, 1 << 30, "from 41 on"}};

struct Plan {
  int robots = 50;
  int matches = 4;  ///< of each robot
  std::uint64_t seed = 1;
  unsigned jobs = 2;
  std::uint32_t possessions = 90;
};

/// A robot in its world: what its kicker is, and what its file says.
struct OneRobot {
  sim::Scenario world{};
  config::Robot file{};
};

/// A way to play.
struct Way {
  const char* name;
  kicking::PolicyName policy;
  SelfCalibrationMode mode;
  std::function<config::Robot(const OneRobot&, int robot)> file = [](const OneRobot& one, int) { return one.file; };
};

/// By band, a tally a match; matches of a robot are one cluster.
using Tallies = std::array<ArmTally, kBands.size()>;

Tallies play(const Plan& plan, const std::vector<OneRobot>& robots, const Way& way) {
  Tallies tallies;
  for (ArmTally& tally : tallies) tally.resize(robots.size() * static_cast<std::size_t>(plan.matches));
  experiment::in_threads(robots.size(), plan.jobs, [&](std::size_t i) {
    experiment::Arm arm;
    arm.policy = way.policy;
    arm.settings.self_calibration.mode = way.mode;
    arm.robots = {way.file(robots[i], static_cast<int>(i))};
    for (int m = 0; m < plan.matches; ++m) {
      const std::size_t match = i * static_cast<std::size_t>(plan.matches) + static_cast<std::size_t>(m);
      int kicks = 0;
      for (const auto& possession :
           experiment::play_match(robots[i].world, arm, plan.seed, static_cast<std::uint32_t>(match), plan.possessions,
                                  {}, nullptr)
               .possessions) {
        const auto band = std::ranges::find_if(kBands, [&](const Band& b) { return kicks <= b.to; });
        log::MatchTally& tally = tallies[static_cast<std::size_t>(band - kBands.begin())][match];
        tally.calibration = static_cast<std::uint32_t>(i);
        ++tally.opportunities;
        if (!possession.kick) continue;
        ++kicks;
        ++tally.kicks;
        tally.on_target += possession.kick->truth == kicking::Outcome::kOnTarget;
      }
    }
  });
  return tallies;
}

void print(const std::string& world, const std::vector<Way>& ways, const std::vector<Tallies>& played) {
  for (std::size_t w = 0; w < ways.size(); ++w) {
    std::string line = fmt::format("{:<44} {:<42}", world, ways[w].name);
    for (std::size_t b = 0; b < kBands.size(); ++b)
      line += fmt::format(
          "  {:<22}", experiment::share_text(experiment::share_of(played[w][b], experiment::Measure::kPerOpportunity)));
    for (std::size_t b = 0; w > 0 && b < kBands.size(); ++b) {
      const std::vector<experiment::Term> terms{{&played[w][b], 1.0}, {&played[0][b], -1.0}};
      line += fmt::format("  {:<22}",
                          experiment::points_text(experiment::contrast(terms, experiment::Measure::kPerOpportunity)));
    }
    fmt::print("{}\n", line);
  }
  std::fflush(stdout);
}

void sweep(const Plan& plan, const std::string& world, const std::vector<OneRobot>& robots,
           const std::vector<Way>& ways) {
  std::vector<Tallies> played;
  for (const Way& way : ways) played.push_back(play(plan, robots, way));
  print(world, ways, played);
}

/// Robots that were calibrated in the default world, whose kickers are as fast as that by `ratio` now.
std::vector<OneRobot> calibrated(const std::vector<config::Robot>& files, double ratio) {
  std::vector<OneRobot> robots;
  for (const config::Robot& file : files) {
    robots.push_back({.world = {}, .file = file});
    robots.back().world.kicker.speed_scale_ratio = ratio;
  }
  return robots;
}

/// Robots with nothing but a guessed file: speed +-15 %, elevation +-3 degrees, delay +-40 ms, drawn evenly.
/// `measured`: the file that a calibration gives each. A robot whose calibration gives none is left out.
std::vector<OneRobot> uncalibrated(const Plan& plan, std::vector<config::Robot>& measured) {
  const config::Robot guessed = config::load_robot(config::shipped("robots/uncalibrated.toml"));
  const kicking::Draws draws{plan.seed, 34};
  const auto drawn = [&](std::size_t i) {
    const auto u = draws.uniforms(kicking::Role::kTeam, static_cast<std::uint32_t>(i));
    OneRobot one{.world = {}, .file = guessed};
    one.world.kicker.speed_scale_ratio = 0.85 + 0.3 * u[0];
    for (double& elevation_rad : one.world.kicker.exit_elevations_rad)
      elevation_rad += (u[1] - 0.5) * 6.0 * std::numbers::pi / 180.0;
    one.world.kicker.delay_s += 0.08 * (u[2] - 0.5);
    return one;
  };
  std::vector<std::optional<config::Robot>> files(static_cast<std::size_t>(plan.robots));
  experiment::in_threads(files.size(), plan.jobs, [&](std::size_t i) {
    const auto seed = experiment::calibration_seed(plan.seed, static_cast<std::uint32_t>(i), 2);
    try {
      files[i] = experiment::calibrated_robot(drawn(i).world, static_cast<std::int64_t>(seed));
    } catch (const std::exception&) {
      files[i].reset();  // a drive that never hits
    }
  });
  std::vector<OneRobot> robots;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (!files[i]) continue;
    robots.push_back(drawn(i));
    measured.push_back(*files[i]);
  }
  if (robots.size() < files.size())
    fmt::print("{} of {} calibrations gave no file: these robots are left out\n", files.size() - robots.size(),
               files.size());
  return robots;
}

/// Kicks after a fall of 5 % until `share` of it is corrected.
void jumps(const Plan& plan, const std::vector<config::Robot>& files, double share) {
  constexpr std::uint32_t kAfter = 20;
  std::vector<double> after;
  int never = 0;
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (int m = 0; m < plan.matches; ++m) {
      OneRobot one{.world = {}, .file = files[i]};
      one.world.kicker.drop_ratio = 0.05;
      one.world.kicker.drop_after_kicks = kAfter;
      experiment::Arm arm;
      arm.policy = kicking::PolicyName::kPredictive;
      arm.settings.self_calibration.mode = SelfCalibrationMode::kOn;
      arm.robots = {one.file};
      experiment::MatchRecord record;
      const auto match =
          static_cast<std::uint32_t>(i * static_cast<std::size_t>(plan.matches)) + static_cast<std::uint32_t>(m);
      experiment::play_match(one.world, arm, plan.seed, match, plan.possessions, {}, &record);
      std::map<std::int64_t, std::size_t> place;
      for (const msg::KickReceipt& receipt : record.receipts)
        if (receipt.accepted) place.emplace(receipt.kick_id, place.size());
      double before = 0.0;
      bool found = false;
      std::size_t kicks = place.size();
      for (const msg::KickerEstimate& estimate : record.estimates) {
        if (estimate.kick_id == 0) continue;
        const std::size_t kick = place.at(estimate.kick_id);
        if (kick < kAfter) before = estimate.speed_ln;
        if (kick < kAfter || found || estimate.speed_ln > before + share * std::log(0.95)) continue;
        after.push_back(static_cast<double>(kick - kAfter + 1));
        found = true;
      }
      if (found || kicks < kAfter + 10) continue;
      after.push_back(HUGE_VAL);
      ++never;
    }
  }
  if (after.empty()) return;
  std::ranges::sort(after);
  fmt::print(
      "\na fall of 5 % after {} kicks: {:.0f} % of it corrected {:.0f} kicks later at the median, {:.0f} at the 90 % "
      "point; never in {} of {} matches\n",
      kAfter, 100.0 * share, after[after.size() / 2], after[after.size() * 9 / 10], never, after.size());
}

}  // namespace

int main(int argc, char** argv) {
  Plan plan;
  CLI::App app{"What a robot that learns its kicker gains"};
  app.add_option("--robots", plan.robots, "drawn without a calibration, and half as many calibrated ones")
      ->check(CLI::Range(4, 1000));
  app.add_option("--matches", plan.matches, "of each robot")->check(CLI::Range(1, 1000));
  app.add_option("--seed", plan.seed, "of everything");
  app.add_option("--jobs", plan.jobs, "threads");
  CLI11_PARSE(app, argc, argv);

  std::vector<config::Robot> files(static_cast<std::size_t>(plan.robots) / 2);
  experiment::in_threads(files.size(), plan.jobs, [&](std::size_t i) {
    files[i] = experiment::calibrated_robot(
        {}, static_cast<std::int64_t>(experiment::calibration_seed(plan.seed, static_cast<std::uint32_t>(i), 1)));
  });
  fmt::print(
      "SIMULATED: {} matches of {} opportunities a robot, seed {}; on target per 100 opportunities, then less the "
      "first row, 95 % by robot\n{:<44} {:<42}",
      plan.matches, plan.possessions, plan.seed, "robots", "play");
  for (int twice = 0; twice < 2; ++twice)
    for (const Band& band : kBands) fmt::print("  {:<22}", band.name);
  fmt::print("\n");
  const kicking::PolicyName moving = kicking::PolicyName::kMoving, predictive = kicking::PolicyName::kPredictive;
  for (const double ratio : {1.0, 1.1}) {
    sweep(plan, fmt::format("{} calibrated{}", files.size(), ratio == 1.0 ? "" : ", kickers 10 % faster now"),
          calibrated(files, ratio),
          {{"predictive", predictive, SelfCalibrationMode::kOff},
           {"predictive, learns", predictive, SelfCalibrationMode::kOn},
           {"moving", moving, SelfCalibrationMode::kOff},
           {"moving, learns", moving, SelfCalibrationMode::kOn}});
  }
  std::vector<config::Robot> measured;
  const std::vector<OneRobot> drawn = uncalibrated(plan, measured);
  sweep(plan, fmt::format("{} drawn, a guessed file", drawn.size()), drawn,
        {{"predictive, after a calibration", predictive, SelfCalibrationMode::kOff,
          [&](const OneRobot&, int robot) { return measured[static_cast<std::size_t>(robot)]; }},
         {"predictive", predictive, SelfCalibrationMode::kOff},
         {"predictive, learns", predictive, SelfCalibrationMode::kOn}});
  for (const double share : {0.5, 0.8}) jumps(plan, files, share);
}
