#pragma once

#include <CLI/CLI.hpp>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "kicking/lob/analyzer.hpp"

namespace trivela::cli {

/// Flags of `trivela lob --points`.
struct PointsFlags {
  std::string points;  ///< CSV file; empty: not asked for
  bool json = false;
  std::string centre = "circle";  ///< or "middle", the paper's
  std::optional<double> cd;       ///< none: fitted
};

void add_points_flags(CLI::App& verb, PointsFlags& flags);

/// Reads foreground returns: columns scan, t_scan_start_s, t_beam_s, angle_deg, range_m. Each bad row is named on `err`
/// with `file`, line, column and value, and the first place where the instants of scans go back or jump. None after
/// one. Throws std::runtime_error if the header is unusable.
std::optional<std::vector<kicking::lob::ForegroundReturn>> read_returns(std::istream& in, const std::string& file,
                                                                        std::ostream& err);

/// Prints the lob in the file to standard output. Returns kDone, or kFailed where a row is bad or the flight is
/// refused. Throws std::runtime_error for a file that cannot be read.
int run_lob_points(const PointsFlags& flags, const kicking::lob::ScannerPlace& place);

}  // namespace trivela::cli
