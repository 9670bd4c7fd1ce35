#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "kicking/lob/analyzer_config.hpp"
#include "kicking/lob/lob_record.hpp"
#include "kicking/lob/scan.hpp"

namespace trivela::kicking::lob {

/// What a page draws of the scan added last.
struct ScanView {
  std::int64_t t_ns = 0;
  bool background_known = false;
  std::vector<std::uint8_t> foreground;  ///< a beam each: 1 nearer than the background
  std::vector<std::uint8_t> ball;        ///< a beam each: 1 of the cluster taken for the ball
  std::optional<BallCentre> centre;
  const std::vector<BallCentre>* track = nullptr;  ///< of the flight under way; null: none
};

/// From scans to lobs: background, foreground, clusters, ball centre, track, fits (paper, section 2.1).
/// The paper says that points matched to the background are the ball; it is the others.
class Analyzer {
 public:
  /// Throws std::invalid_argument for a geometry without beams or with a step or period that is not positive.
  Analyzer(const ScanGeometry& geometry, const LaserMount& mount, const AnalyzerConfig& config = {});
  ~Analyzer();
  Analyzer(Analyzer&&) noexcept;
  Analyzer& operator=(Analyzer&&) noexcept;

  /// Takes the next scan; a flight that has just ended comes back with its fits or the reason for refusing it.
  /// Throws std::invalid_argument for a scan with another number of beams.
  std::optional<LobRecord> add(const Scan& scan);

  /// Ends the flight under way, as at the end of a record.
  std::optional<LobRecord> finish();

  const ScanView& view() const;

  /// The background range of each beam [m]; negative: no return. Empty until it is known.
  const std::vector<double>& background_m() const;

  /// Learns the background again from the next scans.
  void forget_background();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

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
