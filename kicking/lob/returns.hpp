#pragma once

#include <cstdint>
#include <span>

#include "kicking/lob/analyzer_config.hpp"
#include "kicking/lob/lob_record.hpp"

namespace trivela::kicking::lob {

/// One foreground return, as a file holds it. Angles are elevations: 0 along the kick (+x), 90 degrees up.
struct ForegroundReturn {
  std::int64_t scan = 0;       ///< its number
  std::int64_t scan_t_ns = 0;  ///< start of the scan
  std::int64_t beam_t_ns = 0;  ///< of this beam
  double elevation_rad = 0.0;
  double range_m = 0.0;
};

/// Where the scanner stands: x along the kick from the launch, z over the floor.
struct ScannerPlace {
  double x_m = 0.0;
  double z_m = 0.0;
};

/// One lob from its foreground returns alone, in any order: clusters, centres, track and fits as Analyzer has them. The
/// step of the beams is the smallest difference of two elevations in a scan. Of several flights the one with the most
/// centres; without any a record refused as too few points.
/// Throws std::invalid_argument where a scan has two starts or two returns in a beam.
LobRecord analyse_returns(std::span<const ForegroundReturn> returns, const ScannerPlace& place,
                          const AnalyzerConfig& config = {});

}  // namespace trivela::kicking::lob
