#include <benchmark/benchmark.h>

#include "kicking/geometry/time.hpp"
#include "sim/match.hpp"

// The world in process, without filters and policies. `--benchmark_repetitions=9` prints the median.
namespace {

using namespace trivela::sim;

/// Turns and drives on; fires `after_s` into each possession.
struct Driver {
  double after_s;
  std::uint32_t possession_id = 0;
  std::int64_t since_ns = 0;
  bool fired = false;

  Commands operator()(const Sensors& s) {
    Commands commands{.drive = {0.1, 1.0, 0.6}, .fire = {}};
    if (!s.referee.playing || s.referee.possession_id != possession_id) {
      possession_id = s.referee.possession_id;
      since_ns = s.t_ns;
      fired = false;
    } else if (!fired && trivela::kicking::seconds(s.t_ns - since_ns) >= after_s) {
      commands.fire = Fire{s.t_ns, 1, 30.0};
      fired = true;
    }
    return commands;
  }
};

/// Cameras and wheels as a robot in play needs them: the goal camera only for a ball in the air, the rest only without.
SensorChoice needed(const Match& match) {
  const bool held = match.true_state().ball_held;
  return {.wheels = held, .vision = held, .flight = !held};
}

template <class Policy>
void play(
    benchmark::State& state, Policy policy,
    SensorChoice (*choice)(const Match&) = [](const Match&) { return SensorChoice{}; }) {
  std::int64_t cycles = 0, possessions = 0;
  std::uint64_t seed = 0;
  for (auto _ : state) {
    Match match{Scenario{}, ++seed, 1, 600.0, 100};
    while (!match.done()) {
      const Sensors sensors = match.sense(choice(match));
      benchmark::DoNotOptimize(sensors);
      possessions += static_cast<std::int64_t>(match.step(policy(sensors)).possessions.size());
      ++cycles;
    }
  }
  state.counters["possessions/s"] = benchmark::Counter(static_cast<double>(possessions), benchmark::Counter::kIsRate);
  state.counters["cycles/s"] = benchmark::Counter(static_cast<double>(cycles), benchmark::Counter::kIsRate);
  state.counters["cycles/possession"] = static_cast<double>(cycles) / static_cast<double>(possessions);
}

void match_at_rest(benchmark::State& state) {
  play(state, [](const Sensors&) { return Commands{}; });
}
BENCHMARK(match_at_rest)->Unit(benchmark::kMillisecond);

void match_driven(benchmark::State& state) { play(state, Driver{0.5}); }
BENCHMARK(match_driven)->Unit(benchmark::kMillisecond);

void match_driven_with_needed_looks(benchmark::State& state) { play(state, Driver{0.5}, needed); }
BENCHMARK(match_driven_with_needed_looks)->Unit(benchmark::kMillisecond);

}  // namespace
