#include "kicking/fit/table_fit.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

#include "kicking/ballistics/crossing.hpp"
#include "kicking/geometry/angle.hpp"

namespace trivela::kicking {
namespace {

constexpr double kAngleSpread_rad = radians(1.0);  // a warning above it

std::string short_number(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string in_degrees(double angle_rad) {
  return short_number(std::round(degrees(angle_rad) * 100.0) / 100.0) + " degrees";
}

void check(std::span<const Trial> trials) {
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const Trial& trial = trials[i];
    const auto fail = [i](const std::string& why) {
      throw std::invalid_argument("table: trial " + std::to_string(i + 1) + ": " + why);
    };
    if (!(std::isfinite(trial.power) && trial.power > 0.0)) fail("the power must be finite and above 0");
    if (!(std::isfinite(trial.exit_speed_mps) && trial.exit_speed_mps > 0.0)) {
      fail("the exit speed must be finite and above 0");
    }
    if (!std::isnan(trial.exit_angle_rad) &&
        !(trial.exit_angle_rad > 0.0 && trial.exit_angle_rad < 0.5 * std::numbers::pi)) {
      fail("the exit angle must lie between 0 and 90 degrees");
    }
  }
}

using TrialsByPower = std::map<double, std::vector<const Trial*>>;

Spread spread_of(const std::vector<const Trial*>& trials, double Trial::*column) {
  std::vector<double> values;
  for (const Trial* trial : trials) {
    if (!std::isnan(trial->*column)) values.push_back(trial->*column);
  }
  return values.empty() ? Spread{kNotKnown, kNotKnown} : kicking::spread_of(values);
}

double range_of(const std::vector<const Trial*>& trials, double Trial::*column) {
  double least = HUGE_VAL, most = -HUGE_VAL;
  for (const Trial* trial : trials) {
    least = std::fmin(least, trial->*column);
    most = std::fmax(most, trial->*column);
  }
  return most - least;
}

/// Mean angle over the trials that count, spread of the set-points' angles, and what is worth a warning.
void fit_angle(const TrialsByPower& by_power, const TableOptions& options, TableFit& fit) {
  std::vector<double> angles;
  double least = HUGE_VAL;
  double most = -HUGE_VAL;
  for (const TrialMean& point : fit.set_points) {
    if (options.least_angle_power && point.power < *options.least_angle_power) continue;
    for (const Trial* trial : by_power.at(point.power)) {
      if (!std::isnan(trial->exit_angle_rad)) angles.push_back(trial->exit_angle_rad);
    }
    least = std::fmin(least, point.exit_angle_rad.mean);
    most = std::fmax(most, point.exit_angle_rad.mean);
  }
  if (angles.empty() && !options.least_angle_power) throw std::invalid_argument("table: no trial has an exit angle");
  if (angles.empty()) {
    throw std::invalid_argument("table: no power reaches " + short_number(*options.least_angle_power) +
                                ", from which the exit angle counts");
  }
  const Spread spread = kicking::spread_of(angles);
  fit.exit_angle_rad = {spread.mean, spread.sd / std::sqrt(static_cast<double>(angles.size()))};
  fit.exit_angles = angles.size();
  fit.angle_spread_rad = most - least;
  if (fit.angle_spread_rad > kAngleSpread_rad) {
    fit.shared_angle_warning = "the exit angle differs by " + in_degrees(fit.angle_spread_rad) +
                               " from set-point to set-point: one mean angle is wrong for some; "
                               "give each set-point its own";
  }
}

void warn_of_trials(const TrialsByPower& by_power, TableFit& fit) {
  for (const auto& [power, trials] : by_power) {
    const std::string name = "power " + short_number(power);
    if (trials.size() == 1) fit.warnings.push_back(name + ": a single trial, so that its spread is unknown");
    const double range = range_of(trials, &Trial::exit_angle_rad);
    if (range > kAngleSpread_rad) {
      fit.warnings.push_back(name + ": the exit angle differs by " + in_degrees(range) + " from trial to trial");
    }
  }
}

/// Pooled standard deviation of samples; NaN: none has two values.
class PooledSd {
 public:
  void add(double sd, int values) {
    if (values < 2) return;
    squares_ += (values - 1) * sd * sd;
    freedom_ += values - 1;
  }
  double sd() const { return freedom_ > 0 ? std::sqrt(squares_ / freedom_) : kNotKnown; }

 private:
  double squares_ = 0.0;
  int freedom_ = 0;
};

void pool_spreads(const TrialsByPower& by_power, TableFit& fit) {
  PooledSd speeds, ratios, angles;
  double shares = 0.0;
  for (const TrialMean& point : fit.set_points) {
    speeds.add(point.exit_speed_mps.sd, point.trials);
    ratios.add(point.exit_speed_mps.sd / point.exit_speed_mps.mean, point.trials);
    const auto seen = std::ranges::count_if(by_power.at(point.power),
                                            [](const Trial* trial) { return !std::isnan(trial->exit_angle_rad); });
    angles.add(point.exit_angle_rad.sd, static_cast<int>(seen));
    shares += 1.0 / point.trials;
  }
  fit.exit_speed_sd_mps = speeds.sd();
  fit.exit_speed_sd_ratio = ratios.sd();
  fit.exit_angle_sd_rad = angles.sd();
  fit.exit_speed_se_ratio = fit.exit_speed_sd_ratio * std::sqrt(shares / static_cast<double>(fit.set_points.size()));
}

std::vector<std::size_t> not_rising(const std::vector<TrialMean>& points) {
  std::vector<std::size_t> rows;
  double fastest = -HUGE_VAL;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].exit_speed_mps.mean <= fastest) rows.push_back(i);
    fastest = std::max(fastest, points[i].exit_speed_mps.mean);
  }
  return rows;
}

}  // namespace

Trial trial_of_lob(double power, double height_m, double distance_m) {
  const LobExit exit = exit_from_lob(height_m, distance_m);
  return {power, exit.angle_rad, exit.speed_mps};
}

bool TableFit::rises() const { return kicking::not_rising(set_points).empty(); }

std::vector<SetPoint> TableFit::table() const {
  const auto rows = kicking::not_rising(set_points);
  if (!rows.empty()) {
    const TrialMean& point = set_points[rows.front()];
    throw std::invalid_argument("table: power " + short_number(point.power) + " is not faster (" +
                                short_number(point.exit_speed_mps.mean) + " m/s) than a weaker one");
  }
  std::vector<SetPoint> table;
  for (const TrialMean& point : set_points) table.push_back({point.power, point.exit_speed_mps.mean});
  return table;
}

TableFit fit_table(std::span<const Trial> trials, const TableOptions& options) {
  check(trials);
  TrialsByPower by_power;
  for (const Trial& trial : trials) by_power[trial.power].push_back(&trial);
  if (by_power.size() < 2 || by_power.size() > EffectiveTable::kCapacity) {
    throw std::invalid_argument("table: " + std::to_string(by_power.size()) +
                                (by_power.size() == 1 ? " power" : " powers") + ", need 2 to " +
                                std::to_string(EffectiveTable::kCapacity) +
                                (by_power.size() < 2 ? "" : ": leave some out, a table is linear between neighbours"));
  }
  TableFit fit;
  for (const auto& [power, same] : by_power) {
    fit.set_points.push_back({power, static_cast<int>(same.size()), spread_of(same, &Trial::exit_speed_mps),
                              spread_of(same, &Trial::exit_angle_rad)});
  }
  fit_angle(by_power, options, fit);
  warn_of_trials(by_power, fit);
  pool_spreads(by_power, fit);
  fit.not_rising = kicking::not_rising(fit.set_points);
  if (options.isotonic && !fit.not_rising.empty()) {
    std::vector<WeightedSpeed> speeds;
    for (const TrialMean& point : fit.set_points) {
      speeds.push_back({point.exit_speed_mps.mean, static_cast<double>(point.trials)});
    }
    const std::vector<double> rising = rising_speeds(speeds);
    for (std::size_t i = 0; i < rising.size(); ++i) fit.set_points[i].exit_speed_mps.mean = rising[i];
    fit.isotonic = true;
  }
  for (const Trial& trial : trials) {
    const auto point = std::ranges::find(fit.set_points, trial.power, &TrialMean::power);
    fit.residual_mps.push_back(trial.exit_speed_mps - point->exit_speed_mps.mean);
  }
  return fit;
}

namespace {

constexpr double kStepOfPool_mps = 0.002;

struct Pool {
  double speed_mps = 0.0;
  double weight = 0.0;
  std::size_t members = 0;
};

/// Pool adjacent violators: the least-squares fit among those that never fall. Nearer than one step is equal.
std::vector<Pool> pooled(std::span<const WeightedSpeed> speeds) {
  std::vector<Pool> pools;
  for (const WeightedSpeed& speed : speeds) {
    pools.push_back({speed.speed_mps, speed.weight, 1});
    while (pools.size() > 1 && pools[pools.size() - 2].speed_mps + kStepOfPool_mps > pools.back().speed_mps) {
      const Pool last = pools.back();
      pools.pop_back();
      Pool& before = pools.back();
      before.speed_mps =
          (before.weight * before.speed_mps + last.weight * last.speed_mps) / (before.weight + last.weight);
      before.weight += last.weight;
      before.members += last.members;
    }
  }
  return pools;
}

}  // namespace

std::vector<double> rising_speeds(std::span<const WeightedSpeed> speeds) {
  const std::vector<Pool> pools = pooled(speeds);
  std::vector<double> rising;
  for (std::size_t p = 0; p < pools.size(); ++p) {
    const double below = p > 0 ? pools[p].speed_mps - pools[p - 1].speed_mps : HUGE_VAL;
    const double above = p + 1 < pools.size() ? pools[p + 1].speed_mps - pools[p].speed_mps : HUGE_VAL;
    // Half of a gap at most belongs to the pools on its two sides, so that they never meet.
    const double room = 0.5 * std::min(below, above);
    const double step = std::min(kStepOfPool_mps, room / static_cast<double>(pools[p].members));
    for (std::size_t m = 0; m < pools[p].members; ++m) {
      const double place = static_cast<double>(m) - 0.5 * static_cast<double>(pools[p].members - 1);
      rising.push_back(pools[p].speed_mps + place * step);
    }
  }
  return rising;
}

}  // namespace trivela::kicking
