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
  int group = 0;
};

using Readings = std::span<const Reading>;

std::vector<Reading> readings(std::span<const KickResidual> kicks, bool of_heights, std::size_t from, std::size_t end) {
  std::vector<Reading> found;
  for (std::size_t i = from; i < end; ++i) {
    const auto& x = of_heights ? kicks[i].height : kicks[i].speed;
    if (x) found.push_back({i, *x, of_heights && kicks[i].height_at_most, kicks[i].group});
  }
  return found;
}

/// Mean and standard deviation, those that are at most something at their expectation below it (EM).
struct Normal {
  double mean = 0.0, variance = 0.0;
  double n = 0.0;  ///< readings, one that is at most something as the part of it that it tells of the mean
};

Normal fit(Readings readings, double sd) {
  constexpr int kRounds = 30;
  Normal normal{0.0, sd * sd, 0.0};
  const double n = static_cast<double>(readings.size());
  if (readings.empty()) return normal;
  const int rounds = std::ranges::any_of(readings, &Reading::at_most) ? kRounds : 1;
  for (int round = 0; round < rounds; ++round) {
    const double spread = std::sqrt(normal.variance);
    double sum = 0.0, squares = 0.0;
    normal.n = 0.0;
    for (const Reading& r : readings) {
      const double c = (r.x - normal.mean) / spread, m = r.at_most ? mean_below(c) : c;
      const double x = normal.mean + spread * m;
      sum += x;
      normal.n += r.at_most ? std::clamp(m * m - c * m, 0.0, 1.0) : 1.0;  // Fisher's information of the mean
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

std::map<int, std::vector<Reading>> by_group(Readings all) {
  std::map<int, std::vector<Reading>> groups;
  for (const Reading& r : all) groups[r.group].push_back(r);
  return groups;
}

/// Shift between the readings before a place and those from it on, by one spread for both: the mean of the groups'
/// differences, each weighted by n m / (n + m) of its readings. A group on one side alone says nothing.
std::optional<Shift> shift_at(Readings all, std::size_t kick, double sd) {
  double weights = 0.0, shifts = 0.0, squares = 0.0, known = 0.0;
  for (const auto& [group, of_group] : by_group(all)) {
    const Readings both = of_group;
    const auto cut = std::ranges::lower_bound(both, kick, {}, &Reading::kick) - both.begin();
    const Readings before = both.first(static_cast<std::size_t>(cut)), after = both.subspan(before.size());
    if (before.size() < 2 || after.empty()) continue;
    const Normal first = fit(before, sd);
    const Normal second = fit(after, std::sqrt(first.variance));
    const double n = first.n, m = second.n;
    if (!(n > 1.0) || !(m > 0.0)) continue;
    weights += n * m / (n + m);
    shifts += n * m / (n + m) * (second.mean - first.mean);
    squares += (n - 1.0) * first.variance + std::max(0.0, m - 1.0) * second.variance;
    known += n - 1.0 + std::max(0.0, m - 1.0);
  }
  if (weights == 0.0) return std::nullopt;
  return Shift{shifts / weights, std::sqrt(squares / known / weights)};
}

/// The most likely place of the change: that of the greatest W (mean shift)^2, W the sum of the groups' n m / (n + m),
/// n readings before and m after it. What is at most something counts as its expectation below that.
std::size_t change_in(Readings all, double sd) {
  struct Sums {
    double n = 0.0, sum = 0.0;
  };
  std::map<int, Sums> before, whole;
  std::vector<double> values;
  std::map<int, Normal> fits;
  for (const auto& [group, readings] : by_group(all)) fits[group] = fit(readings, sd);
  for (const Reading& r : all) {
    const Normal& normal = fits[r.group];
    const double spread = std::sqrt(normal.variance);
    values.push_back(r.at_most ? normal.mean + spread * mean_below((r.x - normal.mean) / spread) : r.x);
    Sums& sums = whole[r.group];
    sums = {sums.n + 1.0, sums.sum + values.back()};
  }
  constexpr double kFewest = 3.0;  // of a group before it
  std::size_t best = all.size() - 1;
  double best_gain = -1.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    double weights = 0.0, shifts = 0.0;
    for (const auto& [group, sums] : before) {
      const double n = sums.n, m = whole[group].n - n;
      if (n < kFewest || m < 1.0) continue;
      weights += n * m / (n + m);
      shifts += n * m / (n + m) * ((whole[group].sum - sums.sum) / m - sums.sum / n);
    }
    if (weights > 0.0 && shifts * shifts / weights > best_gain) {
      best_gain = shifts * shifts / weights;
      best = i;
    }
    Sums& sums = before[all[i].group];
    sums = {sums.n + 1.0, sums.sum + values[i]};
  }
  return all[best].kick;
}

/// What is said of a shift that alarmed. The place was chosen where the shift is greatest, so the estimate lies too far
/// out and its error is larger: it is drawn towards none, as of a change that is N(0, 5 %) beforehand (assumption).
Shift drawn_in(const Shift& found) {
  constexpr double kBeforehand_sd = 0.05, kOfThePlace = 1.5;  // chosen by how often the interval has the truth
  const double prior = kBeforehand_sd * kBeforehand_sd, se = kOfThePlace * found.se;
  const double kept = prior / (prior + se * se);
  const double drawn = (1.0 - kept) * found.value;  // too far, where the change is larger than was thought
  return {found.value - drawn, std::hypot(std::sqrt(kept) * se, drawn)};
}

class Watch {
 public:
  Watch(std::span<const KickResidual> kicks, const DriftRule& rule) : kicks_(kicks), rule_(rule) {}

  DriftEstimate tell() {
    for (std::size_t i = 0; i < kicks_.size(); ++i) {
      const auto [by_height, by_speed] = add(kicks_[i]);
      if (by_height || by_speed) settle(i, by_height);
    }
    const auto heights = readings(kicks_, true, from_, kicks_.size());
    const auto speeds = readings(kicks_, false, from_, kicks_.size());
    timeline_.level = {from_, heights.size(), speeds.size(), mean_of(heights, rule_.height.expected_sd),
                       mean_of(speeds, rule_.speed.expected_sd)};
    return std::move(timeline_);
  }

 private:
  /// Does the chart of the heights alarm, and that of the exit speeds?
  std::pair<bool, bool> add(const KickResidual& kick) {
    return {kick.height && height_.add(*kick.height, kick.height_at_most, kick.group),
            kick.speed && speed_.add(*kick.speed, false, kick.group)};
  }

  /// The change that kick `found` made certain; the charts begin again with the kicks after it.
  void settle(std::size_t found, bool by_height) {
    const auto heights = readings(kicks_, true, from_, found + 1), speeds = readings(kicks_, false, from_, found + 1);
    Drift drift;
    drift.found = found;
    drift.changed = by_height ? change_in(heights, height_.sd()) : change_in(speeds, speed_.sd());
    drift.speed = shift_at(speeds, drift.changed, speed_.sd());
    const auto height = shift_at(heights, drift.changed, height_.sd());
    drift.factor = (by_height ? height : drift.speed).value_or(Shift{});
    if (by_height && drift.speed) drift.kind = kind_of(*height, *drift.speed);
    drift.factor = drawn_in(drift.factor);
    drift.height_m = drift.factor.value * mean_lever(drift.changed, found);
    timeline_.drifts.push_back(drift);
    from_ = drift.changed;
    height_ = FactorChart(rule_.height);
    speed_ = FactorChart(rule_.speed);
    for (std::size_t i = from_; i <= found; ++i) add(kicks_[i]);
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
  DriftEstimate timeline_;
};

double percent(double ln) { return 100.0 * std::abs(std::exp(ln) - 1.0); }

}  // namespace

DriftEstimate drifts_of(std::span<const KickResidual> kicks, const DriftRule& rule) {
  return Watch(kicks, rule).tell();
}

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
  if (drift.kind == DriftKind::kElevation) return "measure exit_angle_deg again: trivela calibrate table";
  return fmt::format("multiply exit_speeds_mps of its [table] by {:.3f}, or measure it again: trivela calibrate table",
                     std::exp(drift.factor.value));
}

}  // namespace trivela::evaluator
