#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

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

/// Parts `returns`, in the order of their beams, where two neighbours are farther apart than gap_m plus the step of the
/// beams at their range, or more than two beams between them have no foreground. Single returns are left out. `found`
/// is overwritten.
void find_clusters(std::span<const BeamReturn> returns, double step_rad, double gap_m, std::vector<Cluster>& found);

}  // namespace trivela::kicking::lob
