#pragma once

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/e2e/folder.hpp"
#include "tests/e2e/program.hpp"

namespace trivela::e2e {

inline const std::string kRobot = std::string{TRIVELA_SOURCE_DIR} + "/config/robots/cambada_1.toml";

/// Arguments of an experiment of two arms with 20 possessions a match.
inline std::vector<std::string> simulate(const std::string& out, int matches, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"simulate",
                                     "--arms",
                                     "stopped,moving@old",
                                     "--matches",
                                     fmt::format("{}", matches),
                                     "--possessions",
                                     "20",
                                     "--robot",
                                     kRobot,
                                     "--out",
                                     out};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

/// Runs trivela, which must succeed.
inline void run(const Folder& folder, const std::vector<std::string>& arguments) {
  Program program{"trivela", arguments, folder.path()};
  ASSERT_EQ(program.wait(), 0) << program.errors();
}

}  // namespace trivela::e2e
