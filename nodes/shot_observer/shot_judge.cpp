#include "nodes/shot_observer/shot_judge.hpp"

#include <algorithm>
#include <cmath>

#include "kicking/constants.hpp"

namespace trivela::nodes {
namespace {

using kicking::Outcome;

constexpr std::size_t kFewest = 5;         // sightings that a verdict needs
constexpr std::size_t kFewestInPiece = 3;  // that a flight after a bounce is fitted to
constexpr std::size_t kWindow = 7;       // sightings that a velocity is taken from: 0.28 m/s per axis at 3 cm and 50 Hz
constexpr double kLostSpeedShare = 0.6;  // of the expected speed: less was taken away; drag leaves more than 0.9
constexpr double kTurnedAside_mps = 2.0;  // five standard deviations of the difference of two windows
constexpr double kNearFloor_m = 0.25;     // a minimum of z below it is a bounce
const kicking::Ball kBall{};

/// The sightings of the flight up to the first bounce: the release is only expected, so that the first ones may show
/// the ball in the handler still.
std::span<const Sighting> in_the_air(std::span<const Sighting> sightings) {
  std::size_t launch = 0;
  while (launch + 1 < sightings.size() &&
         std::min(sightings[launch].ball_m.z(), sightings[launch + 1].ball_m.z()) < kNearFloor_m) {
    ++launch;
  }
  sightings = sightings.subspan(launch);
  for (std::size_t i = kFewest; i < sightings.size(); ++i) {
    const double low = sightings[i - 1].ball_m.z();
    if (low < kNearFloor_m && low <= sightings[i - 2].ball_m.z() && low < sightings[i].ball_m.z())
      return sightings.first(i);
  }
  return sightings;
}

bool turned_aside(std::span<const Sighting> airborne, double expected_speed_mps) {
  for (std::size_t first = 0; first + kWindow <= airborne.size(); ++first) {
    const auto piece = fit_flight(airborne.subspan(first, kWindow), kicking::kGravity_mps2);
    if (!piece) continue;
    const Eigen::Vector2d velocity = piece->velocity_mps.head<2>();
    if (velocity.norm() < kLostSpeedShare * expected_speed_mps) return true;
    if (first + 2 * kWindow > airborne.size()) continue;
    const auto later = fit_flight(airborne.subspan(first + kWindow, kWindow), kicking::kGravity_mps2);
    if (!later) continue;
    const Eigen::Vector2d along = velocity.normalized();
    const Eigen::Vector2d next = later->velocity_mps.head<2>();
    if (std::abs(next.y() * along.x() - next.x() * along.y()) > kTurnedAside_mps) return true;
  }
  return false;
}

void describe_exit(std::span<const Sighting> airborne, ShotVerdict& verdict) {
  const auto piece = fit_flight(airborne.first(std::min(airborne.size(), kWindow)), kicking::kGravity_mps2);
  if (!piece || airborne.size() < kWindow) return;
  verdict.exit_speed_mps = piece->velocity_mps.norm();
  verdict.exit_elevation_rad = std::atan2(piece->velocity_mps.z(), piece->velocity_mps.head<2>().norm());
}

/// Near the floor all the time: there every minimum of the height is noise.
bool rolls(std::span<const Sighting> sightings) {
  return std::all_of(sightings.begin(), sightings.end(), [](const Sighting& s) { return s.ball_m.z() < kNearFloor_m; });
}

/// The sightings that the crossing is fitted to: what was met at the line itself must not count.
std::span<const Sighting> last_before_line(std::span<const Sighting> sightings, FlightEnd end,
                                           const kicking::Goal& goal, std::size_t frames) {
  const auto farthest = std::max_element(sightings.begin(), sightings.end(), [](const Sighting& a, const Sighting& b) {
    return a.ball_m.y() < b.ball_m.y();
  });
  auto last = static_cast<std::size_t>(farthest - sightings.begin());
  if (end == FlightEnd::kBeyondLine) {
    const auto beyond =
        std::find_if(sightings.begin(), sightings.end(), [&](const Sighting& s) { return s.ball_m.y() > goal.y_m; });
    last = std::min(sightings.size(), static_cast<std::size_t>(beyond - sightings.begin()) + 1);
  }
  const auto before = sightings.first(last);
  const auto latest = before.last(std::min(before.size(), frames));
  if (rolls(latest)) return latest;
  auto piece = after_last_bounce(before, kNearFloor_m);
  // A bounce right before the line leaves too little behind it: the flight before tells where it went.
  for (auto rest = before; piece.size() < kFewestInPiece && piece.size() < rest.size();) {
    rest = rest.first(rest.size() - piece.size());
    piece = after_last_bounce(rest, kNearFloor_m);
  }
  return piece.last(std::min(piece.size(), frames));
}

/// Nearly at rest when it was seen last.
bool slow(std::span<const Sighting> sightings, const config::ShotObserver& settings) {
  const auto piece = fit_flight(sightings.last(kFewest), 0.0);
  return piece && piece->velocity_mps.head<2>().norm() < 3.0 * settings.rest_speed_mps;
}

Outcome nearer_of_post_and_bar(double x_m, double z_m, const kicking::Goal& goal) {
  const double to_post_m = std::abs(std::abs(x_m) - goal.half_width_m);
  const double to_bar_m = std::abs(z_m - goal.height_m);
  return to_post_m < to_bar_m ? Outcome::kPost : Outcome::kBar;
}

}  // namespace

ShotVerdict judge_shot(std::span<const Sighting> sightings, FlightEnd end, double expected_speed_mps,
                       const kicking::Goal& goal, const config::ShotObserver& settings) {
  ShotVerdict verdict;
  const auto airborne = in_the_air(sightings);
  describe_exit(airborne, verdict);
  if (sightings.size() < kFewest) return verdict;
  const auto before_line = last_before_line(sightings, end, goal, settings.fit_frames);
  const bool frame_hit = end == FlightEnd::kThrownBack;
  if (!frame_hit && turned_aside(airborne, expected_speed_mps)) {
    verdict.outcome = Outcome::kBlocked;
    return verdict;
  }
  if (end == FlightEnd::kAtRest) verdict.outcome = Outcome::kShort;
  if (end == FlightEnd::kTakenAway) verdict.outcome = slow(sightings, settings) ? Outcome::kShort : Outcome::kBlocked;
  if (end != FlightEnd::kBeyondLine && !frame_hit) return verdict;

  const auto piece = fit_flight(before_line, rolls(before_line) ? 0.0 : kicking::kGravity_mps2);
  const auto t_s = piece ? piece->time_at_y_s(goal.y_m) : std::nullopt;
  if (!t_s) return verdict;
  const Eigen::Vector3d crossing = piece->at(*t_s);
  verdict.x_cross_m = crossing.x();
  verdict.z_cross_m = std::max(crossing.z(), kBall.radius_m);
  verdict.sd_cross_m = piece->sd_m(*t_s, settings.ball_sd_m);
  verdict.outcome = kicking::classify(*verdict.x_cross_m, *verdict.z_cross_m, goal);
  if (frame_hit && verdict.outcome != Outcome::kPost && verdict.outcome != Outcome::kBar) {
    verdict.outcome = nearer_of_post_and_bar(*verdict.x_cross_m, *verdict.z_cross_m, goal);
  }
  return verdict;
}

}  // namespace trivela::nodes
