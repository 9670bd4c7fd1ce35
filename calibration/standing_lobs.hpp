#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "calibration/drive_source.hpp"
#include "kicking/fit/table_fit.hpp"

namespace trivela::calibration {

/// A lob that the table is made from.
bool is_trial(const kicking::lob::LobRecord& lob);

/// What the scans of one power came to.
struct Tally {
  std::size_t kicks = 0;
  std::size_t lobs = 0;
};

/// By set-point, those of `powers` and of the records.
std::map<double, Tally> tallies_of(const std::vector<double>& powers, const std::vector<DriveRecord>& records);

/// The powers that still need lobs, and kicks with each that should bring them, going by the kicks so far.
struct NextRound {
  std::vector<double> powers;
  std::uint32_t kicks = 0;
};
NextRound next_round(const std::map<double, Tally>& tallies, std::size_t wanted);

/// Throws std::runtime_error where a set-point has too few lobs for a table, saying how many more kicks it needs;
/// `kicks`: with each set-point in the first round.
void require_lobs(const std::map<double, Tally>& tallies, std::uint32_t kicks);

/// Sentences on the standing kicks of which the laser gives no trial.
std::vector<std::string> without_lob(const std::vector<DriveRecord>& records, std::size_t kicks);

/// The table of the trials. Strong set-points lie within each other's errors: then the speeds are pooled, and
/// `left_out` says so.
kicking::TableFit fit_rising(const std::vector<kicking::Trial>& trials, std::vector<std::string>& left_out);

}  // namespace trivela::calibration
