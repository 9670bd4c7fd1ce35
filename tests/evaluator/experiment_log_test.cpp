#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>

#include "tests/evaluator/experiment_fixture.hpp"

namespace trivela::evaluator {
namespace {

// What the log says of one possession, drawn for `policy`.
std::string verdict_on(const std::string& policy) {
  const std::filesystem::path path =
      std::filesystem::path{testing::TempDir()} / ("experiment_log_" + policy + "_" + std::to_string(getpid()) + ".db");
  std::string said;
  {
    TestExperiment experiment{path, 1};
    experiment.begin();
    experiment.session(0, 0, "drawn", {});
    try {
      experiment.possession(1, 1, policy, 0.5, std::nullopt);
    } catch (const std::runtime_error& error) {
      said = error.what();
    }
  }
  for (const char* const suffix : {"", "-wal", "-shm"}) std::filesystem::remove(path.string() + suffix);
  return said;
}

TEST(ExperimentLog, TakesNoNameThatNoPolicyCanHave) {
  EXPECT_EQ(verdict_on("moving"), "");
  EXPECT_EQ(verdict_on("of_another_program"), "");
  EXPECT_THAT(verdict_on("Wild"), testing::AllOf(testing::HasSubstr("experiment_log_Wild"),
                                                 testing::HasSubstr("CHECK constraint failed: policy GLOB")));
}

}  // namespace
}  // namespace trivela::evaluator
