// Programs that are given too little: file descriptors, memory for threads, streams, a temporary folder.
#include <fcntl.h>
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <random>

#include "tests/e2e/log_rows.hpp"
#include "tests/e2e/program.hpp"
#include "tests/support/folder.hpp"

namespace trivela::e2e {
namespace {

using testing::AnyOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

void limit(int resource, rlim_t most) {
  const rlimit both{most, most};
  setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

/// A folder with nodes.toml, a configuration in a domain of its own.
class Limits : public testing::Test {
 protected:
  Limits() {
    std::random_device random;
    std::ofstream{folder_ / "nodes.toml"}
        << fmt::format("[domain]\ndomain_id = {}\ntag = \"limits-{}-{:08x}\"\n", 1 + random() % 100, getpid(), random())
        << "[recorder]\nlog = \"nodes.db\"\n[run]\nrobot = \"" TRIVELA_SOURCE_DIR "/config/robots/cambada_1.toml\"\n"
        << "scenario = \"" TRIVELA_SOURCE_DIR "/config/scenarios/default.toml\"\n";
  }

  void forget(const std::string& log) const {
    for (const char* const suffix : {"", "-wal", "-shm"}) std::filesystem::remove(folder_ / (log + suffix));
  }

  /// Starts a node; ends it by SIGTERM if it works; its exit code.
  int exit_code(const std::string& node, std::string& said, const std::function<void()>& prepare) {
    forget("nodes.db");
    Program program{"trivela-" + node, {"--config", "nodes.toml"}, folder_.path(), prepare};
    if (wait_for_change(folder_.path(), program.watch(),
                        [&] { return program.errors().find("in domain") != std::string::npos; })) {
      program.signal(SIGTERM);
    }
    const int code = program.wait();
    said = program.errors();
    return code;
  }

  tests::Folder folder_;
};

/// With fewer than 7 the dynamic linker may not find the libraries, if the test has descriptors open itself, and says
/// so in the program's place.
TEST_F(Limits, ANodeWithoutFileDescriptorsSaysSo) {
  for (const std::string node : {"world_state", "recorder", "simulator"}) {
    int worked = 0;
    for (const rlim_t descriptors : {7, 8, 9, 10, 11, 12, 13, 14, 16, 18, 20, 22, 24, 32, 64}) {
      SCOPED_TRACE(fmt::format("{} with {}", node, descriptors));
      std::string said;
      const int code = exit_code(node, said, [&] { limit(RLIMIT_NOFILE, descriptors); });
      if (code == 0) {
        ++worked;
      } else {
        EXPECT_EQ(code, 1) << said;
        EXPECT_EQ(worked, 0) << said;
        EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
        EXPECT_THAT(said, HasSubstr(fmt::format("ulimit -n is {}", descriptors)));
        EXPECT_THAT(folder_.files(".db"), IsEmpty());
      }
    }
    EXPECT_GE(worked, 4) << node;
  }
}

TEST_F(Limits, AMatchWithoutFileDescriptorsSaysSo) {
  int worked = 0;
  for (const rlim_t descriptors : {7, 8, 10, 12, 14, 16, 18, 20, 24, 32, 64}) {
    SCOPED_TRACE(fmt::format("{} descriptors", descriptors));
    forget("match.db");
    Program match{"trivela", {"match", "--half", "moving", "--minutes", "0.01"}, folder_.path(), [&] {
                    limit(RLIMIT_NOFILE, descriptors);
                  }};
    const int code = match.wait();
    if (code == 0) {
      ++worked;
      continue;
    }
    EXPECT_EQ(code, 1);
    EXPECT_EQ(worked, 0) << match.errors();
    EXPECT_THAT(match.errors(), AnyOf(HasSubstr("Too many open files"), HasSubstr("ulimit -n is")));
    EXPECT_THAT(match.errors(), Not(HasSubstr("Segmentation")));
    EXPECT_THAT(folder_.files(".db"), IsEmpty());
    EXPECT_THAT(processes_in(folder_.path()), IsEmpty());
  }
  EXPECT_GE(worked, 2);
}

TEST_F(Limits, OtherVerbsEndWithASentence) {
  for (const rlim_t descriptors : {7, 8, 12, 64}) {
    SCOPED_TRACE(fmt::format("{} descriptors", descriptors));
    forget("arms.db");
    Program simulate{"trivela",
                     {"simulate", "--arms", "stopped", "--matches", "1", "--possessions", "2", "--out", "arms.db"},
                     folder_.path(),
                     [&] { limit(RLIMIT_NOFILE, descriptors); }};
    const int code = simulate.wait();
    EXPECT_THAT(code, AnyOf(0, 1));
    EXPECT_EQ(code == 0, simulate.errors().find("trivela: ") == std::string::npos) << simulate.errors();
  }
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // which take all addresses there are
TEST_F(Limits, ANodeWithoutMemoryForThreadsSaysSo) {
  for (const rlim_t megabytes : {40, 60, 80, 400}) {
    SCOPED_TRACE(fmt::format("{} MB", megabytes));
    std::string said;
    const int code = exit_code("world_state", said, [&] { limit(RLIMIT_AS, megabytes << 20); });
    EXPECT_EQ(code, megabytes < 100 ? 1 : 0) << said;
    EXPECT_EQ(code == 0, said.find("threads") == std::string::npos) << said;
  }
}

TEST_F(Limits, AnExperimentWithoutMemoryForThreadsSaysSo) {
  int refused = 0;
  for (const rlim_t megabytes : {36, 42, 50, 60, 80, 400}) {
    SCOPED_TRACE(fmt::format("{} MB", megabytes));
    forget("arms.db");
    Program simulate{
        "trivela",
        {"simulate", "--arms", "stopped", "--matches", "8", "--possessions", "2", "--jobs", "8", "--out", "arms.db"},
        folder_.path(),
        [&] { limit(RLIMIT_AS, megabytes << 20); }};
    const int code = simulate.wait();
    EXPECT_THAT(code, AnyOf(0, 1)) << simulate.errors();
    if (simulate.errors().find("of 8 threads can be started") != std::string::npos) ++refused;
  }
  EXPECT_GE(refused, 2);
}
#endif

TEST_F(Limits, ClosedStreamsAreNoTrouble) {
  for (int closed = 1; closed < 8; ++closed) {
    SCOPED_TRACE(fmt::format("closed: {:03b}", closed));
    const auto close_them = [&] {
      for (int stream = 0; stream < 3; ++stream) {
        if ((closed >> stream) % 2 == 1) close(stream);
      }
    };
    Program wrong{"trivela-recorder", {"--config", "none.toml"}, folder_.path(), close_them};
    EXPECT_EQ(wrong.wait(), 1);
    forget("match.db");
    Program match{"trivela", {"match", "--half", "moving", "--minutes", "0.01"}, folder_.path(), close_them};
    // What could not be written to a closed standard output is an error, but none that keeps the match from its log.
    EXPECT_EQ(match.wait(), (closed >> 1) % 2 == 1 ? 1 : 0) << match.errors();
    EXPECT_THAT(loose_ends_of(folder_ / "match.db"), IsEmpty());
    EXPECT_THAT(Reader{folder_ / "match.db"}.warnings(), IsEmpty());
  }
}

TEST_F(Limits, AFullDiskUnderTheErrorsIsNoCrash) {
  Program wrong{"trivela-recorder", {"--config", "none.toml"}, folder_.path(), [] {
                  dup2(open("/dev/full", O_WRONLY | O_CLOEXEC), STDERR_FILENO);
                }};
  EXPECT_EQ(wrong.wait(), 1);
}

TEST_F(Limits, ANodeWhoseReaderIsGoneGoesOn) {
  Program recorder{"trivela-recorder", {"--config", "nodes.toml"}, folder_.path(), [] {
                     int ends[2];
                     if (pipe2(ends, O_CLOEXEC) == 0) dup2(ends[1], STDERR_FILENO);
                   }};
  ASSERT_TRUE(wait_for_change(folder_.path(), recorder.watch(), [&] { return exists(folder_ / "nodes.db"); }));
  recorder.signal(SIGTERM);
  EXPECT_EQ(recorder.wait(), 0);
  EXPECT_THAT(recorder.output(), HasSubstr("recorded 0 rows"));
}

TEST_F(Limits, AMatchNeedsNeitherATemporaryFolderNorAHome) {
  Program match{"trivela", {"match", "--half", "moving", "--minutes", "0.01"}, folder_.path(), [] {
                  setenv("TMPDIR", "/proc", 1);
                  unsetenv("HOME");
                }};
  EXPECT_EQ(match.wait(), 0) << match.errors();
  EXPECT_THAT(Reader{folder_ / "match.db"}.warnings(), IsEmpty());
}

}  // namespace
}  // namespace trivela::e2e
