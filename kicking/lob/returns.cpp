#include "kicking/lob/returns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "kicking/geometry/time.hpp"
#include "kicking/lob/assessment.hpp"
#include "kicking/lob/candidates.hpp"
#include "kicking/lob/tracker.hpp"

namespace trivela::kicking::lob {
namespace {

using Scans = std::vector<std::span<const ForegroundReturn>>;

/// `returns` in the order of scans and beams, parted into scans.
Scans part(std::span<const ForegroundReturn> returns) {
  Scans scans;
  for (std::size_t first = 0, i = 1; i <= returns.size(); ++i) {
    if (i < returns.size() && returns[i].scan == returns[first].scan) {
      if (returns[i].scan_t_ns == returns[first].scan_t_ns) continue;
      throw std::invalid_argument("scan " + std::to_string(returns[i].scan) +
                                  " has two starts: " + std::to_string(returns[first].scan_t_ns) + " ns and " +
                                  std::to_string(returns[i].scan_t_ns) + " ns");
    }
    scans.push_back(returns.subspan(first, i - first));
    first = i;
  }
  std::sort(scans.begin(), scans.end(),
            [](const auto& a, const auto& b) { return a.front().scan_t_ns < b.front().scan_t_ns; });
  return scans;
}

/// Infinite if no two returns share a scan.
double step_rad(const Scans& scans) {
  double step = std::numeric_limits<double>::infinity();
  for (const auto& scan : scans) {
    for (std::size_t i = 1; i < scan.size(); ++i) {
      const double difference = scan[i].elevation_rad - scan[i - 1].elevation_rad;
      if (difference < 1e-6)
        throw std::invalid_argument("scan " + std::to_string(scan[i].scan) + " has two returns in one beam");
      step = std::min(step, difference);
    }
  }
  return step;
}

/// The shortest time between two scans in a row; a tenth of a second where there is one scan only.
double scan_period_s(const Scans& scans) {
  std::int64_t shortest_ns = 100'000'000;
  for (std::size_t i = 1; i < scans.size(); ++i)
    shortest_ns = std::min(shortest_ns, scans[i].front().scan_t_ns - scans[i - 1].front().scan_t_ns);
  return seconds(shortest_ns);
}

}  // namespace

LobRecord analyse_returns(std::span<const ForegroundReturn> returns, const ScannerPlace& place,
                          const AnalyzerConfig& config) {
  std::vector<ForegroundReturn> sorted(returns.begin(), returns.end());
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
    return std::tie(a.scan, a.elevation_rad) < std::tie(b.scan, b.elevation_rad);
  });
  LobRecord best;
  best.refusal = Refusal::kTooFewPoints;
  best.why = "no flight of a ball among " + std::to_string(returns.size()) + " returns";
  if (sorted.empty()) return best;
  const Scans scans = part(sorted);
  const double step = step_rad(scans);
  if (std::isinf(step)) return best;
  Candidates candidates({.x_m = place.x_m, .z_m = place.z_m}, step, config);
  Tracker tracker(config, scan_period_s(scans));
  std::size_t most = 0;
  const auto keep = [&](std::optional<Flight> flight) {
    if (!flight || flight->centres.size() <= most) return;
    most = flight->centres.size();
    best = assess(std::move(*flight), config);
  };
  std::vector<BeamReturn> beams;
  for (const auto& scan : scans) {
    beams.clear();
    for (const ForegroundReturn& r : scan) {
      beams.push_back({static_cast<int>(std::lround(r.elevation_rad / step)), r.beam_t_ns, r.range_m,
                       std::cos(r.elevation_rad), std::sin(r.elevation_rad)});
    }
    candidates.find(beams);
    keep(tracker.add(scan.front().scan_t_ns, candidates.centres()));
  }
  keep(tracker.finish());
  return best;
}

}  // namespace trivela::kicking::lob
