// How right the shot observer's labels are, by the goal camera: noise, frames a second, dropouts. Simulated.
//     build/release/tests/label_sweep [--matches 40] [--possessions 60] [--seed 1] [--confused]
// With --beliefs: by what robot and observer believe of the world, and is not so.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "tests/experiment/label_sweep.hpp"

namespace {

using namespace trivela;

double percent(double part, int whole) { return whole > 0 ? 100.0 * part / whole : 0.0; }

void say_confused(const experiment::LabelCounts& counts) {
  for (const auto& [what, n] : counts.confused)
    fmt::print("      {} called {}: {}\n", kicking::name(what.first), kicking::name(what.second), n);
}

void sweep_beliefs(std::uint32_t matches, std::uint32_t possessions, std::uint64_t seed, bool confused) {
  fmt::print("SIMULATED: {} matches of {} possessions a world, seed {}\n", matches, possessions, seed);
  fmt::print("{:<80} kicks  unknown  right of given  too good  too bad  bounds hold\n", "world");
  for (const experiment::OtherWorld& world : experiment::kOtherWorlds) {
    experiment::LabelCounts counts;
    for (std::uint32_t match = 0; match < matches; ++match)
      experiment::add_match({}, seed, match, possessions, counts, world);
    fmt::print("{:<79} {:6d}  {:5.1f} %  {:12.2f} %  {:8d} {:8d}  {:9.1f} %\n", world.what, counts.kicks,
               percent(counts.unknown(), counts.kicks), percent(counts.right, counts.given), counts.too_good,
               counts.too_bad, percent(counts.covered, counts.matches));
    if (confused) say_confused(counts);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::uint32_t matches = 40, possessions = 60;
  std::uint64_t seed = 1;
  bool confused = false, beliefs = false;
  double only_sd_m = 0.0, only_frames_per_s = 0.0;
  CLI::App app{"Labels of the shot observer beside the simulator's truth, by the goal camera"};
  app.add_option("--matches", matches, "of each camera")->check(CLI::Range(1, 100000));
  app.add_option("--possessions", possessions, "of a match")->check(CLI::Range(1, 100000));
  app.add_option("--seed", seed, "of all matches");
  app.add_option("--sd", only_sd_m, "only this noise, m");
  app.add_option("--frames", only_frames_per_s, "only so many a second");
  app.add_flag("--confused", confused, "say which labels were wrong");
  app.add_flag("--beliefs", beliefs, "worlds that are not what robot and observer believe, with the default camera");
  CLI11_PARSE(app, argc, argv);
  if (beliefs) {
    sweep_beliefs(matches, possessions, seed, confused);
    return 0;
  }

  fmt::print("SIMULATED: {} matches of {} possessions a camera, seed {}; the observer is told 3 cm\n", matches,
             possessions, seed);
  fmt::print("noise  frames/s  dropouts   kicks  unknown  right of given  expected  too good  too bad  bounds hold\n");
  for (const double sd_m : {0.02, 0.03, 0.05, 0.10, 0.15}) {
    if (only_sd_m > 0.0 && sd_m != only_sd_m) continue;
    for (const double frames_per_s : {10.0, 30.0, 50.0, 60.0}) {
      if (only_frames_per_s > 0.0 && frames_per_s != only_frames_per_s) continue;
      for (const double dropout_ratio : {0.0, 0.2, 0.4}) {
        experiment::LabelCounts counts;
        for (std::uint32_t match = 0; match < matches; ++match)
          experiment::add_match({sd_m, frames_per_s, dropout_ratio}, seed, match, possessions, counts);
        fmt::print("{:3.0f} cm  {:8.0f}  {:6.0f} %  {:6d}  {:5.1f} %  {:12.2f} %  {:6.2f} %  {:8d} {:8d}  {:9.1f} %\n",
                   100.0 * sd_m, frames_per_s, 100.0 * dropout_ratio, counts.kicks,
                   percent(counts.unknown(), counts.kicks), percent(counts.right, counts.given),
                   100.0 - percent(counts.doubt, counts.given), counts.too_good, counts.too_bad,
                   percent(counts.covered, counts.matches));
        if (confused) say_confused(counts);
      }
    }
  }
}
