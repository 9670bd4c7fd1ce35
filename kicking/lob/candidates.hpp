#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kicking/lob/analyzer_config.hpp"
#include "kicking/lob/lob_record.hpp"
#include "kicking/lob/scan.hpp"

namespace trivela::kicking::lob {

/// One foreground return: its beam, when it was measured, and where, from the scanner: range (cos_a, sin_a), a being
/// the elevation of the beam from +x over +z.
struct BeamReturn {
  int beam = 0;
  std::int64_t t_ns = 0;
  double range_m = 0.0;
  double cos_a = 1.0;
  double sin_a = 0.0;
};

/// Returns [first, last] of a scan that hang together.
struct Cluster {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// Parts `returns`, given in the order of their beams, into clusters. One ends between two neighbours where
/// - they are farther apart than gap_m plus the step of the beams at their range, or
/// - more than two beams between them have no foreground.
///
/// Single returns are left out. `found` is overwritten.
void find_clusters(std::span<const BeamReturn> returns, double step_rad, double gap_m, std::vector<Cluster>& found);

/// A centre from the scanner [m].
struct PlanePoint {
  double x = 0.0;
  double z = 0.0;
};

/// The paper's estimate (section 2.1, Figure 3): the middle M of the two outer returns, moved away from the scanner by
/// one ball radius: M + r M / |M|. Literally taken it lies too far by up to r - r^2 / D, D being the distance: 7 cm at
/// 4 m with a quarter of a degree.
PlanePoint middle_of_limits(std::span<const BeamReturn> cluster, double radius_m);

/// A circle of the ball's radius, and the sum of squared range errors that it leaves.
struct CircleFit {
  PlanePoint centre;
  double cost_m2 = 0.0;
};

/// The circle of the ball's radius, least squares in range: minimises sum (range_i - m_i)^2 over the centre at D in
/// direction u, among the centres whose ball crosses every beam of the cluster, |d_i| < asin(r / D):
///   m_i = D cos d_i - sqrt(r^2 - D^2 sin^2 d_i),  d_i the angle of beam i from u.
/// By golden section over the direction (what is feasible is a step of the beams wide), Gauss-Newton in D.
CircleFit circle_of_known_radius(std::span<const BeamReturn> cluster, double radius_m);

/// The cluster without a return at either end, or both, if the squared error falls by more than (3 cm)^2 for each:
/// mixed pixels, half on the ball and half on what is behind. `fit`, that of the whole cluster, becomes that of what is
/// left.
std::span<const BeamReturn> without_mixed_pixels(std::span<const BeamReturn> cluster, CircleFit& fit, double radius_m);

/// The ball's centre if the cluster may be a ball: the angle that it covers is that of a ball there,
///   |(beams) step / (2 asin(r / D)) - 1| <= chord_tolerance.
/// x and z are from the scanner; the time is that of the beam through the centre.
std::optional<BallCentre> find_ball(std::span<const BeamReturn> cluster, double step_rad, const AnalyzerConfig& config);

/// The things of one scan that look like a ball. Buffers are kept from scan to scan.
class Candidates {
 public:
  Candidates(const LaserMount& mount, double step_rad, const AnalyzerConfig& config)
      : mount_(mount), step_rad_(step_rad), config_(config) {}

  /// Clusters the foreground returns of a scan, in the order of their beams, and finds the balls among them.
  void find(std::span<const BeamReturn> returns) {
    centres_.clear();
    of_cluster_.clear();
    find_clusters(returns, step_rad_, config_.cluster_gap_m, clusters_);
    for (const Cluster& cluster : clusters_) {
      auto centre = find_ball(returns.subspan(cluster.first, cluster.last - cluster.first + 1), step_rad_, config_);
      if (!centre) continue;
      centre->x_m += mount_.x_m;
      centre->z_m += mount_.z_m;
      centres_.push_back(*centre);
      of_cluster_.push_back(cluster);
    }
  }

  /// In the frame of the launch.
  const std::vector<BallCentre>& centres() const { return centres_; }
  /// The returns of centre i.
  const Cluster& cluster(std::size_t i) const { return of_cluster_[i]; }

 private:
  LaserMount mount_;
  double step_rad_;
  AnalyzerConfig config_;
  std::vector<Cluster> clusters_;
  std::vector<BallCentre> centres_;
  std::vector<Cluster> of_cluster_;
};

}  // namespace trivela::kicking::lob
