#pragma once

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/faults/team_on_air.hpp"
#include "tests/support/folder.hpp"

namespace trivela::faults {

/// How long anything on the air may take before a test gives up.
inline constexpr std::chrono::seconds kAirTimeout{120};

/// A number from the environment, for longer and larger runs by hand.
inline double by_hand(const char* variable, double otherwise) {
  const char* const text = std::getenv(variable);
  return text == nullptr ? otherwise : std::atof(text);
}

/// Cycles from the instant on in which the robot thought that the game was on, or not.
inline std::int64_t cycles(const std::vector<std::filesystem::path>& logs, bool playing, std::int64_t from_t_ns) {
  return number_in(logs, fmt::format("SELECT count(*) FROM world_states WHERE playing = {} AND t_ns > {}",
                                     playing ? 1 : 0, from_t_ns));
}

inline std::int64_t last_instant(const std::vector<std::filesystem::path>& logs) {
  return number_in(logs, "SELECT max(t_ns) FROM world_states");
}

/// A test of a team on the air, skipped where there are no namespaces. Without more the base's referee lets play from
/// 0.3 s on.
class AirTest : public testing::Test {
 protected:
  void SetUp() override {
    const std::string network = NetworkHost::obstacle(), clock = clock_obstacle();
    if (!network.empty()) GTEST_SKIP() << "no network namespaces here: " << network;
    if (!clock.empty()) GTEST_SKIP() << clock << " here";
  }

  TeamPlan plan() const {
    TeamPlan plan;
    plan.folder = folder.path();
    plan.script = "0.1 FIRST_HALF\n0.3 START\n100000 STOP\n";
    return plan;
  }

  tests::Folder folder;
};

}  // namespace trivela::faults
