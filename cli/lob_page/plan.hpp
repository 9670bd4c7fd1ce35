#pragma once

#include <span>
#include <string>
#include <vector>

#include "kicking/lob/lob_record.hpp"

namespace trivela::cli::lob_page {

/// The powers to calibrate and the kicks of each; two in the paper (section 2.2). No powers: no plan.
struct CalibrationPlan {
  std::vector<double> powers;
  int trials = 2;
};

/// Powers from a list such as "15,20,...,50", where "..." goes on in the step of the two numbers before it. Throws
/// UsageError naming what is wrong with it.
std::vector<double> parse_powers(const std::string& list);

/// Accepted lobs of each power of the plan.
std::vector<int> kicks_done(const CalibrationPlan& plan, std::span<const kicking::lob::LobRecord> lobs);

/// The power to kick with next: `power` while it lacks kicks, else the next of the plan that does, the first ones last;
/// `power` where none does.
double next_power(const CalibrationPlan& plan, const std::vector<int>& done, double power);

}  // namespace trivela::cli::lob_page
