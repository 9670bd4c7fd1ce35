// Experiments that are played in parts, as on the nodes of a cluster: the same rows as one run.
#include <gmock/gmock.h>

#include <algorithm>

#include "tests/e2e/log_rows.hpp"
#include "tests/e2e/simulate_runs.hpp"

namespace trivela::e2e {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kMatches = 7;

std::string shard_file(int number) { return fmt::format("shard_{}.db", number); }

void play_shards(const tests::Folder& folder, int count, const std::vector<std::string>& more = {}) {
  for (int number = 1; number <= count; ++number) {
    std::vector<std::string> flags{"--shard", fmt::format("{}/{}", number, count)};
    flags.insert(flags.end(), more.begin(), more.end());
    run(folder, simulate(shard_file(number), kMatches, flags));
  }
}

/// What a verb that fails says.
std::string refusal(const tests::Folder& folder, const std::vector<std::string>& arguments, int exit_code = 1) {
  Program program{"trivela", arguments, folder.path()};
  EXPECT_EQ(program.wait(), exit_code);
  return program.errors();
}

TEST(Shards, MergeToTheRowsOfOneRun) {
  const tests::Folder folder;
  const std::vector<std::string> calibrations{"simulate",      "--arms", "moving,stopped@old", "--matches", "7",
                                              "--possessions", "20",     "--calibrations",     "2"};
  const auto play = [&](std::vector<std::string> more) {
    more.insert(more.begin(), calibrations.begin(), calibrations.end());
    run(folder, more);
  };
  play({"--out", "whole.db"});
  for (int number = 1; number <= 3; ++number)
    play({"--out", shard_file(number), "--shard", fmt::format("{}/3", number), "--jobs", "2"});
  run(folder, {"merge", "merged.db", "shard_2.db", "shard_3.db", "shard_1.db"});
  EXPECT_THAT(other_rows(folder, "whole.db", "merged.db"), IsEmpty());
  EXPECT_EQ(number_of(Reader{folder / "merged.db"}, "SELECT count(*) FROM sessions"), 2 * kMatches);
  play({"--out", "merged.db"});  // there is nothing left to play
  Program verified{"trivela", {"report", "--verify", "merged.db"}, folder.path()};
  EXPECT_EQ(verified.wait(), 0) << verified.errors();
}

TEST(Shards, ThatAreThereTwiceOrBesideTheWholeSayNothingNew) {
  const tests::Folder folder;
  play_shards(folder, 2);
  run(folder, simulate("whole.db", kMatches));
  std::filesystem::copy_file(folder / "shard_2.db", folder / "again.db");
  run(folder, {"merge", "merged.db", "shard_1.db", "again.db", "shard_2.db"});
  EXPECT_THAT(other_rows(folder, "whole.db", "merged.db"), IsEmpty());
  run(folder, {"note", "shard_2.db", "rain", "--by", "Ada"});
  run(folder, {"merge", "again_merged.db", "shard_2.db", "merged.db", "shard_1.db"});
  EXPECT_EQ(number_of(Reader{folder / "again_merged.db"}, "SELECT count(*) FROM notes"),
            kMatches - kMatches / 2 + kMatches - kMatches / 2)
      << "a note of each session of the second shard, both arms";
  run(folder, {"merge", "third.db", "again_merged.db", "shard_1.db"});
  EXPECT_THAT(other_rows(folder, "again_merged.db", "third.db"), IsEmpty());
}

TEST(Shards, ThatLackOrAreForeignAreNamed) {
  const tests::Folder folder;
  play_shards(folder, 3);
  EXPECT_THAT(refusal(folder, {"merge", "out.db", "shard_1.db", "shard_3.db"}), HasSubstr("missing: 2/3"));
  run(folder, simulate("foreign.db", kMatches, {"--shard", "2/3", "--seed", "2"}));
  EXPECT_THAT(refusal(folder, {"merge", "out.db", "shard_1.db", "foreign.db", "shard_3.db"}),
              AllOf(HasSubstr("foreign.db"), HasSubstr("another experiment")));
  run(folder, simulate("other.db", kMatches, {"--seed", "2"}));
  EXPECT_THAT(refusal(folder, {"merge", "out.db", "shard_1.db", "other.db", "shard_3.db"}),
              AllOf(HasSubstr("other.db"), HasSubstr("another experiment")));
  EXPECT_FALSE(std::filesystem::exists(folder / "out.db"));
}

TEST(Shards, DoNotMergeOverAFileThatIsThere) {
  const tests::Folder folder;
  play_shards(folder, 1);
  run(folder, simulate("whole.db", kMatches));
  EXPECT_THAT(refusal(folder, {"merge", "whole.db", "shard_1.db"}, 2), HasSubstr("whole.db"));
  EXPECT_EQ(number_of(Reader{folder / "whole.db"}, "SELECT count(*) FROM sessions"), 2 * kMatches);
}

TEST(Shards, ThatWereStoppedAreRefusedAndGoOn) {
  const tests::Folder folder;
  constexpr int kMany = 1000;
  {
    Program program{"trivela", simulate("shard_1.db", kMany, {"--shard", "1/2"}), folder.path()};
    const auto wal = folder / "shard_1.db-wal";
    ASSERT_TRUE(wait_for_change(folder.path(), program.watch(), [&] {
      std::error_code missing;
      const auto size = std::filesystem::file_size(wal, missing);
      return !missing && size > 300'000 &&
             number_of(Reader{folder / "shard_1.db"}, "SELECT matches_done FROM experiments") > 0;
    }));
    program.signal(SIGTERM);
    EXPECT_EQ(program.wait(), 1);
    EXPECT_THAT(program.errors(), HasSubstr("of 500 matches are in shard_1.db: the same command goes on from there"));
  }
  run(folder, simulate("shard_2.db", kMany, {"--shard", "2/2"}));
  EXPECT_THAT(refusal(folder, {"merge", "merged.db", "shard_1.db", "shard_2.db"}),
              AllOf(HasSubstr("shard_1.db"), HasSubstr("of its 500 matches")));
  run(folder, simulate("shard_1.db", kMany, {"--shard", "1/2"}));
  run(folder, {"merge", "merged.db", "shard_1.db", "shard_2.db"});
  run(folder, simulate("whole.db", kMany, {"--jobs", "2"}));
  EXPECT_THAT(other_rows(folder, "whole.db", "merged.db"), IsEmpty());
}

TEST(Shards, AreWrittenAsKOfN) {
  const tests::Folder folder;
  for (const std::string text : {"0/3", "4/3", "3", "1/2/3", "-1/3", "a/b"})
    EXPECT_THAT(refusal(folder, simulate("ab.db", 7, {"--shard", text}), 2), HasSubstr("is not K/N")) << text;
  EXPECT_THAT(refusal(folder, simulate("ab.db", 7, {"--shard", "1/8"}), 2), HasSubstr("more parts than --matches 7"));
  EXPECT_FALSE(std::filesystem::exists(folder / "ab.db"));
}

}  // namespace
}  // namespace trivela::e2e
