#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/scenario.hpp"

namespace trivela::config {

/// A world of a study: another one than robots believe.
struct NamedWorld {
  std::string name;
  std::string why;  ///< these values
  sim::Scenario scenario{};
};

/// Reads the [[world]] tables of a file such as config/studies/robustness.toml: name, why, `scenario`, a file relative
/// to this one, else `base`, and `set`, lines of TOML on top. Throws Error naming file, line, key and value; also for a
/// file without worlds, for a world without a name and for two of one name.
std::vector<NamedWorld> load_worlds(const std::filesystem::path& path, const sim::Scenario& base);

}  // namespace trivela::config
