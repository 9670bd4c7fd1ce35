#include <benchmark/benchmark.h>

#include "config/robot.hpp"
#include "config/scenario/scenario.hpp"
#include "config/settings.hpp"
#include "experiment/play/play_match.hpp"

// Matches in process, noise and filters included; items: opportunities.
namespace {

using namespace trivela;

constexpr std::uint32_t kPossessions = 60;

void simulate(benchmark::State& state, kicking::PolicyName policy) {
  const sim::Scenario scenario = config::load_scenario(TRIVELA_SOURCE_DIR "/config/scenarios/default.toml");
  experiment::Arm arm;
  arm.policy = policy;
  arm.settings = config::load_settings(TRIVELA_SOURCE_DIR "/config/default.toml");
  arm.robots = {config::load_robot(TRIVELA_SOURCE_DIR "/config/robots/cambada_1.toml")};
  std::uint32_t match_id = 0;
  std::uint64_t cycles = 0;
  std::int64_t kicks = 0;
  for (auto _ : state) {
    const experiment::PlayedMatch match = experiment::play_match(scenario, arm, 1, match_id++, kPossessions);
    cycles += match.cycles;
    for (const auto& possession : match.possessions) kicks += possession.kick.has_value();
  }
  state.SetItemsProcessed(state.iterations() * kPossessions);
  state.counters["cycles"] = benchmark::Counter(static_cast<double>(cycles), benchmark::Counter::kIsRate);
  state.counters["kicks"] = static_cast<double>(kicks) / static_cast<double>(state.iterations() * kPossessions);
}

BENCHMARK_CAPTURE(simulate, stopped, kicking::PolicyName::kStopped);
BENCHMARK_CAPTURE(simulate, moving, kicking::PolicyName::kMoving);
BENCHMARK_CAPTURE(simulate, predictive, kicking::PolicyName::kPredictive);

}  // namespace

BENCHMARK_MAIN();
