#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kicking/lob/analyzer_config.hpp"
#include "kicking/lob/scan.hpp"

namespace trivela::kicking::lob {

/// What each beam reads while nothing moves, learned from the first scans: median m and median absolute deviation
/// (MAD) of its returns; "no return" is a class of its own. A return r is foreground iff
///   m - r > max(foreground_margin_m, foreground_mads MAD),
/// in a beam that never had a return always. The paper says that points matched to the background are the ball; it is
/// the others.
class Background {
 public:
  /// Throws std::invalid_argument for a configuration that learns from no scan.
  Background(const ScanGeometry& geometry, const AnalyzerConfig& config);

  /// Takes a scan to learn from. True: it was the last one, and the background is known.
  bool learn(const Scan& scan);
  bool known() const { return !range_m_.empty(); }

  /// The background range of each beam [m]; negative: no return in more than half of the scans. Empty until known.
  const std::vector<double>& range_m() const { return range_m_; }

  /// Foreground in beam i; false until known.
  bool is_foreground(std::size_t i, std::uint32_t range_mm) const {
    return range_mm >= first_mm_ && range_mm < nearer_than_mm_[i];
  }

  void forget();

 private:
  bool is_return(std::uint32_t range_mm) const { return range_mm >= first_mm_ && range_mm <= last_mm_; }
  void settle_beam(std::size_t i);

  AnalyzerConfig config_;
  std::size_t beams_;
  std::uint32_t first_mm_;  ///< nearest and farthest that the scanner measures
  std::uint32_t last_mm_;
  std::vector<std::uint32_t> learned_mm_;  ///< (background_scans, beams), row by row
  std::size_t scans_ = 0;
  std::vector<std::uint32_t> one_beam_mm_;
  std::vector<std::uint32_t> nearer_than_mm_;  ///< a beam each
  std::vector<double> range_m_;
};

}  // namespace trivela::kicking::lob
