#include "config/text/installation.hpp"
#include "tests/support/folder.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>

namespace trivela::config {
namespace {

namespace fs = std::filesystem;

/// A folder with a default.toml. This program lies in a build of the sources, whose configuration is there as well.
struct Folder : testing::Test {
  Folder() {
    std::ofstream{machine / "default.toml"} << "";
    unsetenv("TRIVELA_CONFIG");
  }
  ~Folder() override { unsetenv("TRIVELA_CONFIG"); }
  tests::Folder machine;
};

TEST_F(Folder, OfTheSourcesGoesBeforeThatOfTheMachine) {
  EXPECT_EQ(folder(machine), fs::path{TRIVELA_SOURCE_DIR} / "config");
}

TEST_F(Folder, ThatTheEnvironmentNamesGoesBeforeAll) {
  setenv("TRIVELA_CONFIG", machine.path().c_str(), 1);
  EXPECT_EQ(folder("/nowhere"), machine.path());
}

}  // namespace
}  // namespace trivela::config
