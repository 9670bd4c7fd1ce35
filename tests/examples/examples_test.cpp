// The programs of examples/, as a new user runs them.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

#include "kicking/policy/policy.hpp"
#include "tests/nodes/spawned.hpp"
#include "tests/support/folder.hpp"

namespace trivela {
namespace {

using nodes::Spawned;
using testing::HasSubstr;

std::string text_of(const std::string& file) {
  std::ifstream in{std::string{TRIVELA_SOURCE_DIR} + "/" + file};
  return {std::istreambuf_iterator<char>{in}, {}};
}

std::string output_of(const std::string& program, const std::vector<std::string>& arguments = {}) {
  Spawned process{program, arguments};
  EXPECT_EQ(process.exit_code(), 0) << process.said();
  return process.said();
}

/// The words of a line from its last name of a policy on, of each line that has one; what separates them is a blank or
/// a comma.
std::map<std::string, std::vector<std::string>> rows_by_policy(std::string table) {
  std::replace(table.begin(), table.end(), ',', ' ');
  std::map<std::string, std::vector<std::string>> rows;
  std::istringstream lines{table};
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words{line};
    std::vector<std::string> row{std::istream_iterator<std::string>{words}, {}};
    const auto name = std::find_if(row.rbegin(), row.rend(),
                                   [](const std::string& word) { return word == "stopped" || word == "moving"; });
    if (name != row.rend()) rows[*name] = {name.base() - 1, row.end()};
  }
  return rows;
}

TEST(Examples, TheKickIsWhatKickingJudges) {
  kicking::PolicyInput state;
  state.pose = {.x_m = 0.5, .y_m = 4.0, .heading_rad = 0.1};
  state.twist.vy_mps = 1.0;
  state.playing = state.possession = state.kicker_ready = true;
  kicking::PolicyMemory memory;
  const auto output = kicking::evaluate(kicking::PolicyName::kMoving, {}, {}, {}, state, memory);
  ASSERT_TRUE(output.fire);
  EXPECT_EQ(output_of(TRIVELA_BINARY_DIR "/examples/solve_a_kick"),
            fmt::format("fire: fire, {:.2f} m from the target\npower {:.3f} for {:.3f} m/s\n"
                        "crosses the goal line at x = {:.3f} m, z = {:.3f} m\n",
                        output.distance_m, output.power.value(), output.v_kick_mps.value(),
                        output.predicted.value().x_m, output.predicted.value().z_m));
}

TEST(Examples, WhatTheHeaderAndReadmeShowIsInTheProgram) {
  const std::string program = text_of("examples/solve_a_kick.cpp");
  for (const auto& [file, margin] :
       {std::pair{"include/trivela/kicking.hpp", "///     "}, std::pair{"README.md", "    "}}) {
    std::istringstream lines{text_of(file)};
    int shown = 0;
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with(margin) || !line.ends_with(';')) continue;
      EXPECT_THAT(program, HasSubstr(line.substr(std::string{margin}.size()))) << file;
      ++shown;
    }
    EXPECT_GE(shown, 6) << file;
  }
}

TEST(Examples, TheMatchHasTheTableOfSimulate) {
  const tests::Folder folder;
  const std::string log = (folder / "ab.db").string();
  const std::string trivela = TRIVELA_BINARY_DIR "/trivela";
  output_of(trivela, {"simulate", "--arms", "stopped,moving", "--matches", "1", "--possessions", "200", "--seed", "1",
                      "--robot", TRIVELA_SOURCE_DIR "/config/robots/cambada_1.toml", "--out", log});
  const auto simulated = rows_by_policy(output_of(trivela, {"report", log, "--csv"}));
  const std::string table = output_of(TRIVELA_BINARY_DIR "/examples/play_a_match");
  EXPECT_TRUE(table.starts_with("SIMULATED:"));
  auto played = rows_by_policy(table);
  ASSERT_EQ(played.size(), 2u) << table;
  for (const auto& [policy, row] : simulated) {
    EXPECT_GT(std::stoi(row.at(1)), 10) << policy;
    EXPECT_EQ(played[policy].at(1), row.at(1)) << policy << ": inside";
    EXPECT_EQ(played[policy].at(2), row.at(2)) << policy << ": outside";
  }
}

}  // namespace
}  // namespace trivela
