#pragma once

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/e2e/log_rows.hpp"
#include "tests/e2e/program.hpp"
#include "tests/support/folder.hpp"

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
inline void run(const tests::Folder& folder, const std::vector<std::string>& arguments) {
  Program program{"trivela", arguments, folder.path()};
  ASSERT_EQ(program.wait(), 0) << program.errors();
}

/// Tables of which a cell of one log is another in the other; not SQLite's own counts of rows, which it makes where it
/// likes.
inline std::vector<std::string> other_rows(const tests::Folder& folder, const std::string& one,
                                           const std::string& other) {
  const Reader a{folder / one};
  const Reader b{folder / other};
  std::vector<std::string> differing;
  for (const Row& name : rows_of(a, "SELECT name FROM sqlite_schema WHERE type = 'table' AND name <> 'sqlite_stat1'")) {
    const std::string table = std::get<std::string>(name[0]);
    if (rows_of(a, "SELECT * FROM " + table) != rows_of(b, "SELECT * FROM " + table)) differing.push_back(table);
  }
  return differing;
}

/// The match with the seed of the log's only session on the bus, and the streams in which the two differ.
inline std::vector<std::string> differing_on_the_bus(
    const tests::Folder& folder, const std::vector<std::string>& policies, const std::string& program = "trivela",
    const std::function<void()>& prepare = [] {}) {
  const Reader in_process{folder / "in.db"};
  std::vector<std::string> arguments{"match",
                                     "--minutes",
                                     "1000",
                                     "--seed",
                                     fmt::format("{}", number_of(in_process, "SELECT seed FROM sessions")),
                                     "--set",
                                     "simulator.max_possessions=8",
                                     "--out",
                                     "bus.db"};
  arguments.insert(arguments.end(), policies.begin(), policies.end());
  Program match{program, arguments, folder.path(), prepare};
  EXPECT_EQ(match.wait(), 0) << match.errors();
  const Reader bus{folder / "bus.db"};
  EXPECT_GT(number_of(bus, "SELECT count(*) FROM kick_decisions WHERE reason <> 'not_playing'"), 100);
  EXPECT_GT(number_of(bus, "SELECT count(*) FROM kick_orders"), 0);
  std::vector<std::string> differing;
  for (const std::string& difference : differences_of(in_process, bus)) {
    for (const char* const stream :
         {"kick_decisions,", "shadow_decisions,", "kick_orders,", "kick_receipts,", "kick_outcomes,",
          "kicker_estimates,", "kick_truths,", "possession_truths,", "assignments,"}) {
      if (difference.starts_with(stream)) differing.push_back(difference);
    }
  }
  return differing;
}

}  // namespace trivela::e2e
