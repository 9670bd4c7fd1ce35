#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>

#include "config/team/team.hpp"

namespace trivela::cli {

/// The team of a file in which nothing is wrong. Throws std::runtime_error with all that is, a line each; config::Error
/// as load_team() does.
inline config::Team valid_team(const std::string& file) {
  config::ReadTeam read = config::load_team(file);
  std::ranges::move(config::team_findings(read.team), std::back_inserter(read.findings));
  if (!read.findings.empty()) throw std::runtime_error{fmt::format("{}", fmt::join(read.findings, "\n"))};
  return std::move(read.team);
}

}  // namespace trivela::cli
