#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kicking/lob/analyzer.hpp"

namespace trivela::pages {

/// Neighbouring beams of one kind.
struct BeamRun {
  enum Kind { kObject = 1, kBall = 2 };
  std::size_t first = 0;
  std::size_t last = 0;
  int kind = kObject;
};

/// What the analysis said of one scan, small enough to be kept for every scan of a record.
struct SceneView {
  std::int64_t t_ns = 0;
  bool background_known = false;
  std::vector<BeamRun> runs;  ///< the other beams are background
  std::optional<std::array<float, 2>> centre_m;
  std::vector<std::array<float, 2>> track_m;  ///< x, z of the flight under way
};

SceneView scene_of(const kicking::lob::ScanView& view);

/// A frame for the page: {"i", "t_s", "ready", "ranges", "runs": [[first, last, kind], ...], "centre", "track"}.
/// `ranges` is base64 of a 16-bit number a beam, low byte first: mm, 0 where nothing came back, 65535 for all that is
/// farther.
std::string frame_json(std::size_t index, double t_s, std::span<const std::uint32_t> range_mm, double max_range_m,
                       const SceneView& view);

}  // namespace trivela::pages
