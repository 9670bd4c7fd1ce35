#pragma once

#include <cstddef>
#include <optional>

#include "kicking/constants.hpp"
#include "kicking/lob/lob_record.hpp"

namespace trivela::kicking::lob {

/// How scans become lobs. The defaults suit a UTM-30LX or an URG-04LX at 1 to 8 m from the ball.
struct AnalyzerConfig {
  CentreMethod centre = CentreMethod::kCircle;
  std::size_t background_scans = 40;  ///< that the background is learned from, at the start
  double foreground_margin_m = 0.15;  ///< a return is foreground when nearer than the background by this ...
  double foreground_mads = 5.0;       ///< ... and by so many median absolute deviations
  double cluster_gap_m = 0.10;        ///< between neighbouring returns, beside the step of the beams
  double chord_tolerance = 0.40;      ///< of the angle that the ball covers
  double lost_s = 0.15;               ///< a flight ends when the ball was not seen for so long
  int least_points = 8;
  double least_chord_ratio = 0.85;         ///< mean over a third of the flight; below: the plane is misaligned
  double largest_residual_m = 0.03;        ///< rms; above: not the flight of a ball
  double launch_tolerance_m = 1.0;         ///< a flight that starts farther from x = 0 is a bounce or another ball's
  std::optional<double> drag_coefficient;  ///< none: fitted
  Ball ball{};
  double air_density_kgpm3 = 1.2;
};

}  // namespace trivela::kicking::lob
