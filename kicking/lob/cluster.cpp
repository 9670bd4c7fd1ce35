#include "kicking/lob/cluster.hpp"

#include <algorithm>

namespace trivela::kicking::lob {
namespace {

constexpr int kBeamsMissing = 2;  // dropouts within one thing

bool hang_together(const BeamReturn& a, const BeamReturn& b, double step_rad, double gap_m) {
  const int beams = b.beam - a.beam;
  if (beams > kBeamsMissing + 1) return false;
  const double limit_m = gap_m + beams * step_rad * std::max(a.range_m, b.range_m);
  const double cos_ab = a.cos_a * b.cos_a + a.sin_a * b.sin_a;
  const double apart2 = a.range_m * a.range_m + b.range_m * b.range_m - 2.0 * a.range_m * b.range_m * cos_ab;
  return apart2 <= limit_m * limit_m;
}

}  // namespace

void find_clusters(std::span<const BeamReturn> returns, double step_rad, double gap_m, std::vector<Cluster>& found) {
  found.clear();
  std::size_t first = 0;
  for (std::size_t i = 1; i <= returns.size(); ++i) {
    if (i < returns.size() && hang_together(returns[i - 1], returns[i], step_rad, gap_m)) continue;
    if (i - first >= 2) found.push_back({first, i - 1});
    first = i;
  }
}

}  // namespace trivela::kicking::lob
