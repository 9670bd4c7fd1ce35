// Trains `learned` by a search in the space of its decisions (kicking/policy/predictive/learned_decision.hpp): play in
// drawn worlds, common random numbers, mirrored samples. Simulated; rewards are what the robots' observer calls on
// target and, where there is a keeper, true goals.
//     build/release/tests/policy_search --space all --out learned.toml --curve curve.csv
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <random>

#include "config/learned_model.hpp"
#include "tests/bench/drawn_worlds.hpp"

namespace {

using namespace trivela;
using namespace trivela::bench;
using kicking::LearnedDecision;

/// A number that is searched: how far it is moved at first, and its limits.
struct Knob {
  std::string name;
  std::function<double&(LearnedDecision&)> of;
  double step, least, most;
};

void add_firing(std::vector<Knob>& knobs) {
  for (std::size_t i = 0; i < kicking::kFireFeatures; ++i)
    knobs.push_back({fmt::format("fire_weights.{}", kicking::kFireFeatureNames[i]),
                     [i](LearnedDecision& d) -> double& { return d.fire_weights[i]; }, 0.015, -1.0, 1.0});
  const auto ratio = [&](const char* name, double LearnedDecision::*field, double step, double least, double most) {
    knobs.push_back({name, [field](LearnedDecision& d) -> double& { return d.*field; }, step, least, most});
  };
  ratio("threshold_ratio", &LearnedDecision::threshold_ratio, 0.25, 0.0, 2.0);
  ratio("goal_threshold_ratio", &LearnedDecision::goal_threshold_ratio, 0.5, 0.0, 10.0);
  ratio("position_ratio", &LearnedDecision::position_ratio, 0.2, 0.0, 3.0);
  ratio("heading_ratio", &LearnedDecision::heading_ratio, 0.25, 0.0, 4.0);
  ratio("speed_ratio", &LearnedDecision::speed_ratio, 0.3, 0.0, 5.0);
  ratio("turn_rate_ratio", &LearnedDecision::turn_rate_ratio, 0.3, 0.0, 5.0);
  ratio("hazard_ratio", &LearnedDecision::hazard_ratio, 0.5, 0.0, 5.0);
  ratio("dispute_shift_m", &LearnedDecision::dispute_shift_m, 0.05, -0.3, 0.3);
  ratio("blocking_ratio", &LearnedDecision::blocking_ratio, 0.15, 0.0, 1.2);
  ratio("lever_worth", &LearnedDecision::lever_worth, 0.05, 0.5, 1.0);
  ratio("switch_margin", &LearnedDecision::switch_margin, 0.002, 0.0, 0.05);
}

void add_driving(std::vector<Knob>& knobs, std::size_t styles) {
  for (std::size_t i = 0; i < styles; ++i) {
    const auto part = [&](const char* name, double kicking::DriveStyle::*field, double step, double least,
                          double most) {
      knobs.push_back({fmt::format("style[{}].{}", i, name),
                       [i, field](LearnedDecision& d) -> double& { return d.style[i].*field; }, step, least, most});
    };
    part("speed_ratio", &kicking::DriveStyle::speed_ratio, 0.25, -0.4, 1.8);
    part("side_ratio", &kicking::DriveStyle::side_ratio, 0.4, 0.0, 8.0);
    part("brake_ratio", &kicking::DriveStyle::brake_ratio, 0.25, 0.5, 4.0);
    part("aim_ratio", &kicking::DriveStyle::aim_ratio, 0.12, -0.3, 0.9);
  }
}

struct Flags {
  std::string space = "all", out = "learned.toml", curve = "learned_curve.csv", from;
  std::uint64_t seed = 7001;
  std::uint32_t worlds = 48, held_out_worlds = 24, matches = 1, possessions = 30;
  std::size_t styles = 3;
  int generations = 60, pairs = 12, every = 5;
  bool places = false, scan = false;
  unsigned jobs = 1;
};

LearnedDecision start_of(const Flags& flags) {
  LearnedDecision d;
  if (!flags.from.empty()) d = config::load_learned_model(flags.from).model.decision;
  if (flags.places) d.opponent_places = true;
  if (flags.space == "fire" || !flags.from.empty()) return d;
  d.styles = flags.styles;
  d.style[1] = {.speed_ratio = 0.4, .side_ratio = 3.0};
  if (flags.styles > 2) d.style[2] = {.speed_ratio = 1.4, .brake_ratio = 1.5, .aim_ratio = 0.4};
  if (flags.styles > 3) d.style[3] = {.speed_ratio = 0.8, .brake_ratio = 1.5, .aim_ratio = 0.6};
  return d;
}

/// Search gradients of a normal distribution whose width stays (natural evolution strategies, Wierstra et al. 2014):
/// samples are mirrored, utilities go by rank, and what counts is the mean's running average.
class Search {
 public:
  static constexpr double kRate = 0.5, kForgets = 0.1;

  Search(const Flags& flags, std::vector<Knob> knobs, LearnedDecision start)
      : flags_(flags), knobs_(std::move(knobs)), start_(start), random_{flags.seed} {
    for (const Knob& knob : knobs_) {
      mean_.push_back(knob.of(start_));
      average_.push_back(mean_.back());
      sd_.push_back(knob.step);
    }
  }

  LearnedDecision decision(const std::vector<double>& values) const {
    LearnedDecision d = start_;
    for (std::size_t k = 0; k < knobs_.size(); ++k)
      knobs_[k].of(d) = std::clamp(values[k], knobs_[k].least, knobs_[k].most);
    return d;
  }
  LearnedDecision mean() const { return decision(average_); }

  /// One generation. `play`: rewards of these decisions, of the same opportunities.
  void learn(const std::function<std::vector<double>(const std::vector<LearnedDecision>&)>& play) {
    const std::size_t n = knobs_.size();
    std::vector<std::vector<double>> drawn;
    std::vector<LearnedDecision> decisions;
    std::normal_distribution<double> normal;
    for (int pair = 0; pair < flags_.pairs; ++pair) {
      std::vector<double> z(n);
      for (double& one : z) one = normal(random_);
      for (const double sign : {1.0, -1.0}) {
        drawn.push_back(z);
        std::vector<double> values = mean_;
        for (std::size_t k = 0; k < n; ++k) {
          drawn.back()[k] *= sign;
          values[k] += sd_[k] * drawn.back()[k];
        }
        decisions.push_back(decision(values));
      }
    }
    const std::vector<double> rewards = play(decisions);
    std::vector<std::size_t> order(rewards.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return rewards[a] > rewards[b]; });
    std::vector<double> utility(order.size());
    double sum = 0.0;
    for (std::size_t rank = 0; rank < order.size(); ++rank)
      sum += utility[order[rank]] = std::max(
          0.0, std::log(0.5 * static_cast<double>(order.size()) + 1.0) - std::log(static_cast<double>(rank) + 1.0));
    for (std::size_t k = 0; k < n; ++k) {
      double step = 0.0;
      for (std::size_t i = 0; i < order.size(); ++i) step += utility[i] / sum * drawn[i][k];
      mean_[k] = std::clamp(mean_[k] + kRate * sd_[k] * step, knobs_[k].least, knobs_[k].most);
      average_[k] += kForgets * (mean_[k] - average_[k]);
    }
  }

 private:
  const Flags& flags_;
  std::vector<Knob> knobs_;
  mutable LearnedDecision start_;
  std::mt19937_64 random_;
  std::vector<double> mean_, average_, sd_;
};

void write(const Flags& flags, const LearnedDecision& decision) {
  config::LearnedModelFile file;
  file.model.decision = decision;
  file.training.source = "policy_search";
  std::ofstream{flags.out} << config::to_toml_text(file);
}

/// What single changes do, by themselves.
void scan(const Flags& flags) {
  const std::vector<DrawnWorld> worlds = draw_worlds(flags.seed, flags.worlds, flags.jobs);
  std::vector<Knob> knobs;
  if (flags.space != "drive") add_firing(knobs);
  if (flags.space != "fire") add_driving(knobs, flags.styles);
  const LearnedDecision start = start_of(flags);
  const auto play = [&](const std::optional<LearnedDecision>& d) {
    return play_worlds(worlds, {d}, flags.seed, 1000, flags.matches, flags.possessions, flags.jobs)[0];
  };
  const auto hand = play(std::nullopt), base = play(start);
  const auto say = [](const std::string& name, const Difference& d) {
    fmt::print("{:40} {:+.2f} +- {:.2f}\n", name, 100.0 * d.mean, 100.0 * d.reach);
    std::fflush(stdout);
  };
  fmt::print("predictive {:.2f}\n", 100.0 * mean_of(hand));
  say("start - predictive", difference_of(base, hand));
  for (const Knob& knob : knobs) {
    for (const double sign : {1.0, -1.0}) {
      LearnedDecision d = start;
      double& value = knob.of(d);
      const double was = value;
      value = std::clamp(value + 2.0 * sign * knob.step, knob.least, knob.most);
      if (value == was) continue;
      say(fmt::format("{} {:.3f} -> {:.3f}", knob.name, was, value), difference_of(play(d), base));
    }
  }
}

void train(const Flags& flags) {
  const std::vector<DrawnWorld> worlds = draw_worlds(flags.seed, flags.worlds, flags.jobs);
  const std::vector<DrawnWorld> held_out = draw_worlds(flags.seed + 1, flags.held_out_worlds, flags.jobs);
  fmt::print("SIMULATED: {} training worlds, {} held out\n", worlds.size(), held_out.size());
  std::vector<Knob> knobs;
  if (flags.space != "drive") add_firing(knobs);
  if (flags.space != "fire") add_driving(knobs, flags.styles);
  Search search{flags, knobs, start_of(flags)};
  std::ofstream curve{flags.curve};
  curve << "generation,opportunities,training,held_out,held_out_low,held_out_high\n";
  const std::vector<std::optional<LearnedDecision>> by_hand{std::nullopt};
  const auto base =
      play_worlds(held_out, by_hand, flags.seed + 1, 0, 4 * flags.matches, flags.possessions, flags.jobs)[0];
  std::uint64_t opportunities = 0;
  for (int generation = 0; generation <= flags.generations; ++generation) {
    double training = NAN;
    if (generation > 0) {
      search.learn([&](const std::vector<LearnedDecision>& decisions) {
        const std::vector<std::optional<LearnedDecision>> all(decisions.begin(), decisions.end());
        const auto first = static_cast<std::uint32_t>(generation) * flags.matches;
        const auto played = play_worlds(worlds, all, flags.seed, first, flags.matches, flags.possessions, flags.jobs);
        opportunities += decisions.size() * worlds.size() * flags.matches * flags.possessions;
        std::vector<double> rewards;
        rewards.reserve(played.size());
        for (const auto& by_match : played) rewards.push_back(mean_of(by_match));
        training = mean_of(rewards);
        return rewards;
      });
    }
    if (generation % flags.every != 0) continue;
    const LearnedDecision now = search.mean();
    const auto played =
        play_worlds(held_out, {now}, flags.seed + 1, 0, 4 * flags.matches, flags.possessions, flags.jobs)[0];
    const Difference d = difference_of(played, base);
    curve << fmt::format("{},{},{:.4f},{:.4f},{:.4f},{:.4f}\n", generation, opportunities, 100.0 * training,
                         100.0 * d.mean, 100.0 * (d.mean - d.reach), 100.0 * (d.mean + d.reach))
          << std::flush;
    fmt::print("{:3d} {:9d} opportunities: training {:.2f}, held out {:+.2f} +- {:.2f} to predictive's {:.2f}\n",
               generation, opportunities, 100.0 * training, 100.0 * d.mean, 100.0 * d.reach, 100.0 * mean_of(base));
    std::fflush(stdout);
    write(flags, now);
  }
}

int run(int argc, char** argv) {
  Flags flags;
  CLI::App app{"Trains the learned policy by a search in drawn worlds"};
  app.add_option("--space", flags.space, "What is searched")->check(CLI::IsMember({"fire", "drive", "all"}));
  app.add_option("--out", flags.out, "The model's file");
  app.add_option("--curve", flags.curve, "Learning curve (CSV)");
  app.add_option("--from", flags.from, "Begin with this model");
  app.add_option("--seed", flags.seed, "of worlds, matches and samples");
  app.add_option("--worlds", flags.worlds, "Training worlds");
  app.add_option("--held-out-worlds", flags.held_out_worlds, "Worlds of the learning curve");
  app.add_option("--matches", flags.matches, "of each world and generation");
  app.add_option("--possessions", flags.possessions, "Opportunities of a match");
  app.add_option("--styles", flags.styles, "of driving")->check(CLI::Range(1, static_cast<int>(kicking::kDriveStyles)));
  app.add_option("--generations", flags.generations, "of the search");
  app.add_option("--pairs", flags.pairs, "of mirrored samples in a generation");
  app.add_option("--every", flags.every, "Generations between two points of the curve");
  app.add_flag("--places", flags.places, "It goes by where opponents stand");
  app.add_flag("--scan", flags.scan, "What single changes do, instead of a search");
  app.add_option("--jobs", flags.jobs, "Threads");
  CLI11_PARSE(app, argc, argv);
  flags.scan ? scan(flags) : train(flags);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fputs(error.what(), stderr);
    return 1;
  }
}
