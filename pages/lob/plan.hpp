#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kicking/lob/lob_record.hpp"

namespace trivela::pages {

/// The powers to calibrate and the kicks of each; two in the paper (section 2.2). No powers: no plan.
struct CalibrationPlan {
  std::vector<double> powers;
  int trials = 2;
};

/// Powers from a list such as "15,20,...,50", where "..." goes on in the step of the two numbers before it. Throws
/// config::BadArgument naming what is wrong with it, and the list as `called`.
std::vector<double> parse_powers(const std::string& text, const std::string& called = "plan");

/// Accepted lobs of each power of the plan.
std::vector<int> kicks_done(const CalibrationPlan& plan, std::span<const kicking::lob::LobRecord> lobs);

/// The power to kick with next after an accepted kick with `power`: the same while it lacks kicks, else the next of the
/// plan that does, the first ones last. None: that kick was the plan's last, and what is kicked after it is no trial of
/// any power until somebody names one. A power that was named by hand when the plan was done, or in none, stays.
std::optional<double> next_power(const CalibrationPlan& plan, const std::vector<int>& done, double power);

}  // namespace trivela::pages
