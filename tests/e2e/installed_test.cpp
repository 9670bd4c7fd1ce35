// An installed Trivela, far from its sources: its programs, and another project's build with it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <memory>

#include "bus/reader.hpp"
#include "bus/writer.hpp"
#include "idl/messages.hpp"
#include "log/read/reader.hpp"
#include "tests/e2e/program.hpp"
#include "tests/support/folder.hpp"

namespace trivela::e2e {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::vector<std::string> kOneMatch{"simulate",      "--arms", "moving", "--matches", "1",
                                         "--possessions", "2",      "--out",  "ab.db"};

class Installed : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    prefix_ = std::make_unique<tests::Folder>();
    Program install{TRIVELA_CMAKE, {"--install", TRIVELA_BINARY_DIR, "--prefix", prefix_->path()}, prefix_->path()};
    ASSERT_EQ(install.wait(), 0) << install.output() << install.errors();
  }
  static void TearDownTestSuite() { prefix_.reset(); }

  static fs::path prefix() { return fs::canonical(prefix_->path()); }
  static std::string program(const std::string& name) { return prefix() / "bin" / name; }
  static std::string config() { return prefix() / "share/trivela/config"; }

  /// What a program prints that must end well.
  std::string output_of(const std::string& name, const std::vector<std::string>& arguments) const {
    Program process{name, arguments, folder_.path()};
    EXPECT_EQ(process.wait(), 0) << name << process.output() << process.errors();
    return process.output();
  }

  tests::Folder folder_;

 private:
  inline static std::unique_ptr<tests::Folder> prefix_;
};

TEST_F(Installed, EveryProgramFindsTheInstalledConfiguration) {
  int programs = 0;
  for (const auto& entry : fs::directory_iterator{prefix() / "bin"}) {
    EXPECT_THAT(output_of(entry.path(), {"--version"}), HasSubstr("\nconfiguration: " + config() + "\n"));
    ++programs;
  }
  EXPECT_EQ(programs, 16);
}

TEST_F(Installed, NoProgramNamesTheSources) {
#ifndef NDEBUG
  GTEST_SKIP() << "assert() names its file";
#endif
  for (const auto& entry : fs::directory_iterator{prefix() / "bin"}) {
    const std::string text = text_of(entry.path());
    for (const auto& room : fs::directory_iterator{TRIVELA_SOURCE_DIR}) {
      if (!room.is_directory()) continue;  // a library's own "./src/..." is none of ours
      EXPECT_EQ(text.find(room.path().string() + '/'), std::string::npos) << entry << room;
    }
  }
}

TEST_F(Installed, AMatchIsPlayedInAnotherFolder) {
  output_of(program("trivela"), {"match", "--half", "moving", "--minutes", "0.2", "--seed", "1", "--out", "match.db"});
  const log::Reader log{folder_ / "match.db"};
  ASSERT_EQ(log.sessions().size(), 1u);
  EXPECT_TRUE(log.sessions()[0].closed_t_ns);
}

TEST_F(Installed, AProgramByItselfSaysThatItsConfigurationIsMissing) {
  fs::copy_file(program("trivela"), folder_ / "trivela");
  const std::string alone = folder_ / "trivela";
  const std::string missing = "the shipped configuration is neither near the program nor installed";
  EXPECT_THAT(output_of(alone, {"--version"}), HasSubstr(missing));
  Program lost{alone, kOneMatch, folder_.path()};
  EXPECT_EQ(lost.wait(), 1);
  EXPECT_THAT(lost.errors(), HasSubstr(missing + "; TRIVELA_CONFIG may name its folder"));

  fs::copy(config(), folder_ / "config", fs::copy_options::recursive);
  EXPECT_THAT(output_of(alone, {"--version"}), HasSubstr("\nconfiguration: " + (folder_ / "config").string() + "\n"));
  output_of(alone, kOneMatch);
}

TEST_F(Installed, TrivelaConfigGoesBeforeAllPlaces) {
  fs::copy(config(), folder_ / "mine", fs::copy_options::recursive);
  const auto mine = [&] { setenv("TRIVELA_CONFIG", (folder_ / "mine").c_str(), 1); };
  Program told{program("trivela"), {"--version"}, folder_.path(), mine};
  EXPECT_EQ(told.wait(), 0);
  EXPECT_THAT(told.output(), HasSubstr("\nconfiguration: " + (folder_ / "mine").string() + "\n"));

  const auto nowhere = [] { setenv("TRIVELA_CONFIG", "/nowhere", 1); };
  Program wrong{program("trivela"), kOneMatch, folder_.path(), nowhere};
  EXPECT_EQ(wrong.wait(), 1);
  EXPECT_THAT(wrong.errors(), HasSubstr("/nowhere/"));
  EXPECT_THAT(wrong.errors(), HasSubstr("TRIVELA_CONFIG names a folder without default.toml"));
}

TEST_F(Installed, AnotherProjectFindsAndUsesIt) {
  output_of(TRIVELA_CMAKE, {"-S", TRIVELA_SOURCE_DIR "/tests/consumer", "-B", "consumer", "-G", "Ninja",
                            "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_PREFIX_PATH=" + prefix().string()});
  output_of(TRIVELA_CMAKE, {"--build", "consumer", "-j", "1"});
  const std::string kick = output_of(folder_ / "consumer/kicking_alone", {});
  EXPECT_THAT(kick, HasSubstr("fire: fire"));
  EXPECT_EQ(kick, output_of("examples/solve_a_kick", {}));
  EXPECT_EQ(output_of(folder_ / "consumer/examples/play_a_match", {}), output_of("examples/play_a_match", {}));

  const auto on_the_path = [] { setenv("PATH", ((prefix() / "bin").string() + ":/usr/bin:/bin").c_str(), 1); };
  Program own{folder_ / "consumer/examples/patient",
              {"match", "--half", "patient", "--half", "moving", "--minutes", "0.2", "--seed", "1", "--out", "own.db"},
              folder_.path(),
              on_the_path};
  EXPECT_EQ(own.wait(), 0) << own.errors();
  EXPECT_THAT(output_of(program("trivela"), {"report", "own.db"}), HasSubstr("patient"));

  const std::string tag = "consumer-test-" + std::to_string(getpid());
  bus::Writer<msg::KickDecision> writer{bus::Participant{bus::loopback(19, tag)}};
  Program listener{folder_ / "consumer/examples/listen_to_decisions", {"19", tag}, folder_.path()};
  EXPECT_TRUE(writer.wait_for_readers(1, kTimeout)) << listener.errors();

  const auto at_home = [&] {
    setenv("CYCLONEDDS_URI", ("file://" + config() + "/cyclonedds/loopback.xml").c_str(), 1);
    setenv("TRIVELA_TAG", tag.c_str(), 1);
  };
  bus::Reader<msg::DeviceWheels> wheels{bus::Participant{bus::loopback(19, tag)}};
  bus::Reader<msg::FlightFrame> camera{bus::Participant{bus::loopback(19, tag)}};
  Program bridge{folder_ / "consumer/examples/bridge/bridge", {"19"}, folder_.path(), at_home};
  Program vision{folder_ / "consumer/examples/vision/vision", {"19"}, folder_.path(), at_home};
  EXPECT_TRUE(wheels.wait(kTimeout)) << bridge.errors();
  EXPECT_TRUE(camera.wait(kTimeout)) << vision.errors();
}

}  // namespace
}  // namespace trivela::e2e
