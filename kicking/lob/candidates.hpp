#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kicking/lob/analyzer_config.hpp"
#include "kicking/lob/ball_centre.hpp"
#include "kicking/lob/cluster.hpp"
#include "kicking/lob/lob_record.hpp"
#include "kicking/lob/scan.hpp"

namespace trivela::kicking::lob {

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
