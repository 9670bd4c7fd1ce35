#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>

#include "config/team_check.hpp"

namespace trivela::cli {

/// The team of a file in which nothing is wrong. Throws std::runtime_error with the first finding, and how many there
/// are; config::Error as load_team() does.
inline config::Team sound_team(const std::string& file) {
  config::ReadTeam read = config::load_team(file);
  std::ranges::move(config::team_findings(read.team), std::back_inserter(read.findings));
  if (read.findings.empty()) return std::move(read.team);
  throw std::runtime_error{read.findings.size() == 1
                               ? read.findings.front()
                               : fmt::format("{} (and {} more: trivela team check {})", read.findings.front(),
                                             read.findings.size() - 1, file)};
}

}  // namespace trivela::cli
