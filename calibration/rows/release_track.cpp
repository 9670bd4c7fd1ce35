#include "calibration/rows/release_track.hpp"

#include <algorithm>
#include <vector>

#include "kicking/constants.hpp"

namespace trivela::calibration {
namespace {

constexpr double kHeld_s = 0.2;
constexpr double kTrack_s = 0.5;
constexpr double kAway_m = 0.25;  // eight standard deviations of a sighting: the ball has left
constexpr std::size_t kFewest = 5;
constexpr std::size_t kMostInFlight = 8;

/// p(t) = start + velocity g(t).
struct Track {
  Eigen::Vector3d start_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();
};

struct Place {
  double t_s;  ///< after the order
  Eigen::Vector3d ball_m;
};

/// Least squares over the places, g(t) = t - slowing (t - t_0)^2 / 2 with t_0 that of the first place.
Track fit_track(std::span<const Place> places, double slowing_hz) {
  const auto elapsed_s = [&](const Place& place) {
    const double t_s = place.t_s - places.front().t_s;
    return place.t_s - 0.5 * slowing_hz * t_s * t_s;
  };
  const auto n = static_cast<double>(places.size());
  double mean_t_s = 0.0;
  Eigen::Vector3d mean_m = Eigen::Vector3d::Zero();
  for (const Place& place : places) {
    mean_t_s += elapsed_s(place) / n;
    mean_m += place.ball_m / n;
  }
  double spread_s2 = 0.0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (const Place& place : places) {
    const double away_s = elapsed_s(place) - mean_t_s;
    spread_s2 += away_s * away_s;
    moment += away_s * (place.ball_m - mean_m);
  }
  const Eigen::Vector3d velocity = moment / spread_s2;
  return {mean_m - velocity * mean_t_s, velocity};
}

}  // namespace

std::optional<double> release_delay_s(std::span<const BallSighting> sightings, std::int64_t order_t_ns) {
  std::vector<Place> held, after;
  for (const BallSighting& sighting : sightings) {
    const double t_s = 1e-9 * static_cast<double>(sighting.t_ns - order_t_ns);
    if (t_s >= -kHeld_s && t_s <= 0.0) held.push_back({t_s, sighting.ball_m});
    if (t_s > 0.0 && t_s <= kTrack_s) after.push_back({t_s, sighting.ball_m});
  }
  if (held.size() < kFewest) return std::nullopt;
  const Track handler = fit_track(held, 0.0);
  const auto gone = [&](const Place& place) {
    return (place.ball_m - handler.start_m - handler.velocity_mps * place.t_s).head<2>().norm() > kAway_m;
  };
  const auto first = std::ranges::find_if(after, gone);
  const auto left = static_cast<std::size_t>(after.end() - first);
  if (left < kFewest) return std::nullopt;
  const std::span<const Place> flight(first, std::min(left, kMostInFlight));
  const double speed_mps = fit_track(flight, 0.0).velocity_mps.norm();
  const Track ball = fit_track(flight, kicking::drag_per_m({}, {}) * speed_mps);

  // Backwards from the first place the drag is neglected: within 0.05 s it is a millimetre.
  const Eigen::Vector2d apart_m = (handler.start_m - ball.start_m).head<2>();
  const Eigen::Vector2d closing_mps = (ball.velocity_mps - handler.velocity_mps).head<2>();
  const double squared = closing_mps.squaredNorm();
  if (!(squared > 0.0)) return std::nullopt;
  return apart_m.dot(closing_mps) / squared;
}

}  // namespace trivela::calibration
