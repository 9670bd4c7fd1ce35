#include "evaluator/drift/drift_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace trivela::evaluator {
namespace {

/// One residual of a kick.
struct Reading {
  std::size_t kick = 0;  ///< its place
  double x = 0.0;
  bool at_most = false;
};

using Readings = std::span<const Reading>;

std::vector<Reading> readings(std::span<const KickResidual> kicks, bool of_heights, std::size_t from, std::size_t end) {
  std::vector<Reading> found;
  for (std::size_t i = from; i < end; ++i) {
    const auto& x = of_heights ? kicks[i].height : kicks[i].speed;
    if (x) found.push_back({i, *x, of_heights && kicks[i].height_at_most});
  }
  return found;
}

/// Mean and standard deviation, those that are at most something at their expectation below it (EM).
struct Normal {
  double mean = 0.0, variance = 0.0;
};

Normal fit(Readings readings, double sd) {
  constexpr int kRounds = 30;
  Normal normal{0.0, sd * sd};
  const double n = static_cast<double>(readings.size());
  if (readings.empty()) return normal;
  const int rounds = std::ranges::any_of(readings, &Reading::at_most) ? kRounds : 1;
  for (int round = 0; round < rounds; ++round) {
    const double spread = std::sqrt(normal.variance);
    double sum = 0.0, squares = 0.0;
    for (const Reading& r : readings) {
      const double c = (r.x - normal.mean) / spread, m = r.at_most ? mean_below(c) : c;
      const double x = normal.mean + spread * m;
      sum += x;
      squares += x * x + (r.at_most ? std::max(0.0, 1.0 + c * m - m * m) * normal.variance : 0.0);
    }
    normal.mean = sum / n;
    if (n > 2.0) normal.variance = std::max(1e-8, (squares - n * normal.mean * normal.mean) / (n - 1.0));
  }
  return normal;
}

Shift mean_of(Readings readings, double sd) {
  if (readings.empty()) return {};
  const Normal normal = fit(readings, sd);
  return {normal.mean, std::sqrt(normal.variance / static_cast<double>(readings.size()))};
}

/// Shift between the readings before a place and those from it on, by one spread for both.
std::optional<Shift> shift_at(Readings all, std::size_t kick, double sd) {
  const auto cut = std::ranges::lower_bound(all, kick, {}, &Reading::kick) - all.begin();
  const Readings before = all.first(static_cast<std::size_t>(cut)), after = all.subspan(static_cast<std::size_t>(cut));
  if (before.size() < 2 || after.empty()) return std::nullopt;
  const double n = static_cast<double>(before.size()), m = static_cast<double>(after.size());
  const Normal first = fit(before, sd);
  const double spread = std::sqrt(first.variance);
  const Normal second = fit(after, spread);
  const double pooled = ((n - 1.0) * first.variance + (m - 1.0) * second.variance) / (n + m - 2.0);
  return Shift{second.mean - first.mean, std::sqrt(pooled * (1.0 / n + 1.0 / m))};
}

/// The most likely place of the change: that of the greatest n m / (n + m) (mean after - mean before)^2. What is at
/// most something counts as its expectation below that.
std::size_t change_in(Readings all, double sd) {
  const Normal normal = fit(all, sd);
  const double spread = std::sqrt(normal.variance);
  std::vector<double> sums{0.0};
  for (const Reading& r : all) {
    const double x = r.at_most ? normal.mean + spread * mean_below((r.x - normal.mean) / spread) : r.x;
    sums.push_back(sums.back() + x);
  }
  constexpr std::size_t kFewest = 3;  // before it
  std::size_t best = all.size() - 1;
  double best_gain = -1.0;
  for (std::size_t i = kFewest; i < all.size(); ++i) {
    const double n = static_cast<double>(i), m = static_cast<double>(all.size() - i);
    const double shift = (sums.back() - sums[i]) / m - sums[i] / n;
    const double gain = n * m / (n + m) * shift * shift;
    if (gain <= best_gain) continue;
    best_gain = gain;
    best = i;
  }
  return all[best].kick;
}

class Watch {
 public:
  Watch(std::span<const KickResidual> kicks, const DriftRule& rule) : kicks_(kicks), rule_(rule) {}

  DriftStory tell() {
    for (std::size_t i = 0; i < kicks_.size(); ++i) {
      const bool by_height = add(height_, kicks_[i].height, kicks_[i].height_at_most);
      const bool by_speed = add(speed_, kicks_[i].speed, false);
      if (by_height || by_speed) settle(i, by_height);
    }
    const auto heights = readings(kicks_, true, from_, kicks_.size());
    const auto speeds = readings(kicks_, false, from_, kicks_.size());
    story_.level = {from_, heights.size(), speeds.size(), mean_of(heights, rule_.height.expected_sd),
                    mean_of(speeds, rule_.speed.expected_sd)};
    return std::move(story_);
  }

 private:
  static bool add(FactorChart& chart, const std::optional<double>& x, bool at_most) {
    return x && chart.add(*x, at_most);
  }

  /// The change that kick `found` made certain; the charts begin anew with the kicks after it.
  void settle(std::size_t found, bool by_height) {
    const auto heights = readings(kicks_, true, from_, found + 1), speeds = readings(kicks_, false, from_, found + 1);
    Drift drift;
    drift.found = found;
    drift.changed = by_height ? change_in(heights, height_.sd()) : change_in(speeds, speed_.sd());
    drift.speed = shift_at(speeds, drift.changed, speed_.sd());
    const auto height = shift_at(heights, drift.changed, height_.sd());
    drift.factor = (by_height ? height : drift.speed).value_or(Shift{});
    if (by_height && drift.speed) drift.kind = kind_of(*height, *drift.speed);
    drift.height_m = drift.factor.value * mean_lever(drift.changed, found);
    story_.drifts.push_back(drift);
    from_ = drift.changed;
    height_ = FactorChart(rule_.height);
    speed_ = FactorChart(rule_.speed);
    for (std::size_t i = from_; i <= found; ++i) {
      add(height_, kicks_[i].height, kicks_[i].height_at_most);
      add(speed_, kicks_[i].speed, false);
    }
  }

  /// The angle alone, where exit speeds are far from what the heights say and near to none.
  static DriftKind kind_of(const Shift& height, const Shift& speed) {
    const double differ = std::abs(height.value - speed.value), se = std::hypot(height.se, speed.se);
    const bool is_speed = differ < 2.0 * se || std::abs(speed.value) > 2.0 * speed.se;
    return is_speed ? DriftKind::kExitSpeed : DriftKind::kElevation;
  }

  double mean_lever(std::size_t from, std::size_t to) const {
    double sum = 0.0;
    int n = 0;
    for (std::size_t i = from; i <= to; ++i) {
      if (!kicks_[i].height && !kicks_[i].speed) continue;
      sum += kicks_[i].metres;
      ++n;
    }
    return n > 0 ? sum / n : 0.0;
  }

  std::span<const KickResidual> kicks_;
  const DriftRule& rule_;
  FactorChart height_{rule_.height}, speed_{rule_.speed};
  std::size_t from_ = 0;  // the kicks that the charts have seen begin here
  DriftStory story_;
};

double percent(double ln) { return 100.0 * std::abs(std::exp(ln) - 1.0); }

}  // namespace

DriftStory drifts_of(std::span<const KickResidual> kicks, const DriftRule& rule) { return Watch(kicks, rule).tell(); }

std::string words_of(const Drift& drift) {
  const char* const way = drift.factor.value < 0.0 ? "fell" : "rose";
  if (drift.kind == DriftKind::kElevation)
    return fmt::format("balls cross {:.2f} m {} (standard error {:.2f}) with the exit speed as it was",
                       std::abs(drift.height_m), drift.height_m < 0.0 ? "lower" : "higher",
                       std::abs(drift.height_m * drift.factor.se / drift.factor.value));
  return fmt::format("exit speed {} by {:.1f} % (standard error {:.1f})", way, percent(drift.factor.value),
                     100.0 * drift.factor.se);
}

std::string correction_of(const Drift& drift) {
  if (drift.kind == DriftKind::kElevation) return "measure exit_angle_deg anew: trivela calibrate table";
  return fmt::format("multiply exit_speeds_mps of its [table] by {:.3f}, or measure it anew: trivela calibrate table",
                     std::exp(drift.factor.value));
}

}  // namespace trivela::evaluator
