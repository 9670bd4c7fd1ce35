#include "kicking/fit/transfer_fit.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "kicking/ballistics/crossing.hpp"
#include "kicking/fit/tracked_fits.hpp"

namespace trivela::kicking {
namespace {

constexpr double kLeastShare = 0.1;  // of its own horizontal speed that the ball keeps with any k tried

[[noreturn]] void fail(std::size_t row, const std::string& why) {
  throw std::invalid_argument("transfer: row " + std::to_string(row + 1) + ": " + why);
}

void check(std::span<const TransferRow> rows, double delay_s) {
  if (!std::isfinite(delay_s)) throw std::invalid_argument("transfer: the delay is not finite");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const TransferRow& row = rows[i];
    if (!std::isfinite(row.vy_mps + row.v0_mps + row.exit_angle_rad + row.distance_m + row.z_cross_m)) {
      fail(i, "a value is not finite");
    }
    if (!(row.v0_mps > 0.0)) fail(i, "the exit speed must be above 0");
    if (!(row.exit_angle_rad > 0.0 && row.exit_angle_rad < 0.5 * std::numbers::pi)) {
      fail(i, "the exit angle must lie between 0 and 90 degrees");
    }
    if (!(std::min(row.distance_m, row.distance_m - row.vy_mps * delay_s) > 0.0)) {
      fail(i, "the ball must leave before the goal line");
    }
  }
}

/// A kick in the exact law, as a function of k alone.
struct Kick {
  double v_mps = 0.0;
  double v_h_mps = 0.0;  ///< of a robot at rest
  double v_z_mps = 0.0;
  double distance_m = 0.0;  ///< at the release
  double height_m = 0.0;    ///< observed, over the launch

  double residual_m(double k, double gravity_mps2) const {
    return height_m - height_at(distance_m, v_h_mps + k * v_mps, v_z_mps, gravity_mps2);
  }
  /// dz/dk with T = d / v_h: (v_z - g T) dT/dk, dT/dk = -T v / v_h.
  double slope_m(double k, double gravity_mps2) const {
    const double v_h = v_h_mps + k * v_mps;
    const double t = distance_m / v_h;
    return -(v_z_mps - gravity_mps2 * t) * t * v_mps / v_h;
  }
  bool flies(double k) const { return v_h_mps + k * v_mps >= kLeastShare * v_h_mps; }
};

/// Least squares in height by Gauss and Newton from k = 1, steps halved while they do not help.
class ExactFit {
 public:
  ExactFit(std::vector<Kick> kicks, double gravity_mps2) : kicks_(std::move(kicks)), gravity_mps2_(gravity_mps2) {}

  double solve() const {
    double k = 1.0;
    for (int i = 0; i < 100; ++i) {
      double step = 0.0;
      for (const Kick& kick : kicks_) {
        step += kick.slope_m(k, gravity_mps2_) * kick.residual_m(k, gravity_mps2_) / information(k);
      }
      for (int halvings = 0; !better(k + step, k) && halvings < 40; ++halvings) step *= 0.5;
      if (!better(k + step, k)) return k;
      k += step;
      if (std::abs(step) < 1e-12) return k;
    }
    throw std::invalid_argument("transfer: no k explains the heights");
  }

  double squares(double k) const {
    double sum = 0.0;
    for (const Kick& kick : kicks_) sum += std::pow(kick.residual_m(k, gravity_mps2_), 2);
    return sum;
  }

  /// Sum of (dz/dk)^2 [m2]. Throws std::invalid_argument where no height depends on k.
  double information(double k) const {
    double sum = 0.0;
    for (const Kick& kick : kicks_) sum += std::pow(kick.slope_m(k, gravity_mps2_), 2);
    if (!(sum > 1e-12))
      throw std::invalid_argument("transfer: no height depends on k: the balls cross at the top of their flight");
    return sum;
  }

  std::vector<double> residuals_m(double k) const {
    std::vector<double> residuals;
    for (const Kick& kick : kicks_) residuals.push_back(kick.residual_m(k, gravity_mps2_));
    return residuals;
  }

 private:
  bool better(double candidate, double k) const {
    const bool all_fly = std::ranges::all_of(kicks_, [&](const Kick& kick) { return kick.flies(candidate); });
    return all_fly && squares(candidate) < squares(k);
  }

  std::vector<Kick> kicks_;
  double gravity_mps2_;
};

struct World {
  double delay_s;
  double ball_radius_m;
  double gravity_mps2;
};

double needed_v0_mps(std::span<const TransferRow> rows, std::size_t i, const World& world) {
  const TransferRow& row = rows[i];
  const auto v0_mps =
      crossing_speed({row.distance_m, row.z_cross_m - world.ball_radius_m}, row.exit_angle_rad, world.gravity_mps2);
  if (!v0_mps) fail(i, "at this exit angle no speed reaches the height");
  return *v0_mps;
}

std::optional<Estimate> standing_ratio(std::span<const TransferRow> rows, const World& world) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].at_rest()) ratios.push_back(needed_v0_mps(rows, i, world) / rows[i].v0_mps);
  }
  if (ratios.size() < 2) return std::nullopt;
  const auto n = static_cast<double>(ratios.size());
  const double mean = std::accumulate(ratios.begin(), ratios.end(), 0.0) / n;
  double squares = 0.0;
  for (const double ratio : ratios) squares += (ratio - mean) * (ratio - mean);
  return Estimate{mean, std::sqrt(squares / (n - 1.0) / n)};
}

Estimate paper_ratio(std::span<const TransferRow> rows, const std::vector<std::size_t>& chosen, const World& world) {
  std::vector<double> along, slower;
  for (const std::size_t i : chosen) {
    along.push_back(rows[i].vy_mps * std::cos(rows[i].exit_angle_rad));
    slower.push_back(needed_v0_mps(rows, i, world) - rows[i].v0_mps);
  }
  return line_through_origin(along, slower, "transfer").slope;
}

std::vector<TransferRow> scaled(std::span<const TransferRow> rows, double ratio) {
  std::vector<TransferRow> out(rows.begin(), rows.end());
  for (TransferRow& row : out) row.v0_mps *= ratio;
  return out;
}

std::optional<TransferDirection> direction(std::span<const TransferRow> rows, double sign, const World& world) {
  TransferDirection result;
  std::vector<Kick> kicks;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const TransferRow& row = rows[i];
    if (sign * row.vy_mps < TransferRow::kLeastSpeed_mps) continue;
    result.rows.push_back(i);
    kicks.push_back({row.vy_mps, row.v0_mps * std::cos(row.exit_angle_rad), row.v0_mps * std::sin(row.exit_angle_rad),
                     row.distance_m - row.vy_mps * world.delay_s, row.z_cross_m - world.ball_radius_m});
  }
  if (kicks.size() < 2) return std::nullopt;
  const auto n = static_cast<double>(kicks.size());
  const ExactFit fit(std::move(kicks), world.gravity_mps2);
  const double k = fit.solve();
  result.kicks = static_cast<int>(n);
  result.exact = {k, std::sqrt(fit.squares(k) / (n - 1.0) / fit.information(k))};
  result.paper = paper_ratio(rows, result.rows, world);
  result.residual = fit.residuals_m(k);
  result.rms = std::sqrt(fit.squares(k) / n);
  return result;
}

}  // namespace

TransferFit fit_transfer(std::span<const TransferRow> rows, double delay_s, double ball_radius_m, double gravity_mps2) {
  check(rows, delay_s);
  if (!rows.empty() && std::ranges::all_of(rows, [](const TransferRow& row) { return row.track.has_value(); }))
    return fit_tracked_transfer(rows, delay_s, gravity_mps2);
  const World world{delay_s, ball_radius_m, gravity_mps2};
  TransferFit fit{standing_ratio(rows, world), {}, {}, {}};
  const Estimate ratio = fit.standing_ratio.value_or(Estimate{1.0, 0.0});
  const auto fit_directions = [&](double v0_ratio, std::vector<std::string>& failed) {
    const auto corrected = scaled(rows, v0_ratio);
    std::array<std::optional<TransferDirection>, 2> fits;
    for (const std::size_t i : {0u, 1u}) {
      try {
        fits[i] = direction(corrected, i == 0 ? 1.0 : -1.0, world);
      } catch (const std::invalid_argument& error) {
        failed.push_back(std::string(i == 0 ? "forward: " : "backward: ") + error.what());
      }
    }
    return fits;
  };
  auto directions = fit_directions(ratio.value, fit.failed);
  if (ratio.se > 0.0) {
    std::vector<std::string> of_moved;
    const auto moved = fit_directions(ratio.value + ratio.se, of_moved);
    for (std::size_t i = 0; i < directions.size(); ++i) {
      if (!directions[i] || !moved[i]) continue;
      for (const auto k : {&TransferDirection::exact, &TransferDirection::paper}) {
        Estimate& estimate = (*directions[i]).*k;
        estimate.se = std::hypot(estimate.se, ((*moved[i]).*k).value - estimate.value);
      }
    }
  }
  fit.forward = std::move(directions[0]);
  fit.backward = std::move(directions[1]);
  if (!fit.forward && !fit.backward) {
    if (!fit.failed.empty()) throw std::invalid_argument(fit.failed.front());
    throw std::invalid_argument("transfer: need at least 2 kicks forward or 2 kicks backward, faster than 0.05 m/s");
  }
  return fit;
}

}  // namespace trivela::kicking
