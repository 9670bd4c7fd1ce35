// What several verbs check of their flags before they begin: shards, worlds, numbers, and files that they will write.
#include <gmock/gmock.h>

#include <fstream>
#include <iterator>

#include "cli/options/number_checks.hpp"
#include "cli/options/output.hpp"
#include "cli/options/play_options.hpp"
#include "cli/verbs.hpp"
#include "tests/support/folder.hpp"

namespace trivela::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

std::optional<log::Shard> shard_of(const std::string& text) {
  CLI::App app;
  std::optional<log::Shard> shard;
  add_shard_option(app, shard, "");
  app.parse(std::vector<std::string>{text, "--shard"});
  return shard;
}

TEST(ShardOption, IsKOfNAndNothingElse) {
  EXPECT_EQ(shard_of("2/4"), (log::Shard{2, 4}));
  EXPECT_EQ(shard_of("4/4"), (log::Shard{4, 4}));
  for (const char* const wrong :
       {"0/4", "5/4", "1", "1/", "/4", "1/4x", "1 /4", "-1/4", "1/0", "1.5/4", "1/99999999999"})
    EXPECT_THROW(shard_of(wrong), CLI::ValidationError) << wrong;
}

TEST(ShardOption, NeedsAMatchForEachShard) {
  EXPECT_NO_THROW(check_shard(log::Shard{1, 4}, 4));
  EXPECT_NO_THROW(check_shard(std::nullopt, 0));
  EXPECT_THAT(
      [] {
        check_shard(log::Shard{1, 4}, 3);
      },
      ThrowsMessage<UsageError>(HasSubstr("--shard 1/4: more parts than --matches 3")));
}

TEST(WorldOption, ValuesOnTopCountAndStandInTheName) {
  World world;
  world.changes = {"keeper.reaction_s = 0.31", "keeper.enabled = true"};
  const sim::Scenario scenario = world.load();
  EXPECT_EQ(scenario.keeper.guard.reaction_s, 0.31);
  EXPECT_TRUE(scenario.keeper.enabled);
  EXPECT_EQ(world.named("default"), "default, keeper.reaction_s = 0.31, keeper.enabled = true");
  EXPECT_EQ(World{}.named("default"), "default");
}

TEST(WorldOption, AValueThatIsNoneIsNamedWithTheFlag) {
  for (const auto& [line, says] :
       {std::pair{"keeper.reacts = 0.3", "reacts"}, std::pair{"keeper.reaction_s = 'x'", "keeper.reaction_s"},
        std::pair{"keeper.reaction_s = -1", "-1"}}) {
    World world;
    world.changes = {line};
    EXPECT_THAT([&] { world.load(); }, ThrowsMessage<config::Error>(AllOf(HasSubstr("--world"), HasSubstr(says))));
  }
}

TEST(NumberChecks, NoNumberThatIsNoneGetsThrough) {
  CLI::Validator within = between(0.0, 1.0), above = above_zero();
  for (std::string good : {"0", "1", "0.5"}) EXPECT_EQ(within(good), "") << good;
  for (std::string bad : {"-0.1", "1.1", "nan", "0.5x", ""})
    EXPECT_THAT(within(bad), HasSubstr("within 0 to 1")) << bad;
  std::string zero = "0", small = "1e-9", nan = "nan";
  EXPECT_EQ(above(zero), "0 is not above 0");
  EXPECT_EQ(above(small), "");
  EXPECT_NE(above(nan), "");
}

TEST(WrittenFiles, AreAskedForBeforeTheWorkAndLeftAsTheyAre) {
  const tests::Folder folder;
  EXPECT_NO_THROW(require_writable("--out", ""));
  EXPECT_NO_THROW(require_writable("--out", folder / "new.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder / "new.csv")) << "nothing is left of the question";
  std::ofstream{folder / "old.csv"} << "kept";
  EXPECT_NO_THROW(require_writable("--out", folder / "old.csv"));
  std::ifstream in(folder / "old.csv");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), "kept");
  EXPECT_THAT([&] { require_writable("--svg", folder.path()); },
              ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("cannot write --svg"), HasSubstr("it is a folder"))));
  EXPECT_THAT([&] { require_writable("--svg", folder / "no/a.svg"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("there is no folder")));
}

TEST(WrittenFiles, ThatMustBeNewMayBeEmptyAndNothingElse) {
  const tests::Folder folder;
  EXPECT_NO_THROW(require_new("--out", folder / "new.db"));
  std::ofstream{folder / "empty.db"}.close();
  EXPECT_NO_THROW(require_new("--out", folder / "empty.db"));
  std::ofstream{folder / "full.db"} << "a log";
  for (const char* const taken : {"full.db", "."}) {
    EXPECT_THAT([&] { require_new("--out", folder / taken); },
                ThrowsMessage<config::BadArgument>(HasSubstr("exists already and is never overwritten")))
        << taken;
  }
}

TEST(WorldOption, AValueOfWhatTheWorldHasNotIsBadUsage) {
  World world;
  for (const char* const line : {"keeper.reaction_s=0.15", "keeper.speed_mps = 2.5", "kicker.flat.delay_s=0.1"}) {
    world.changes = {line};
    EXPECT_THAT([&] { world.require_effect({world.load()}); },
                ThrowsMessage<UsageError>(HasSubstr(".enabled = false in this world")))
        << line;
  }
  world.changes = {"keeper.reaction_s=0.15"};
  const sim::Scenario without = world.load();
  sim::Scenario with = without;
  with.keeper.enabled = true;
  EXPECT_NO_THROW(world.require_effect({without, with})) << "one of a study's worlds has it";
  EXPECT_THAT([&] { world.require_effect({without, without}); }, ThrowsMessage<UsageError>(HasSubstr("in all worlds")));
  world.changes = {"keeper.reaction_s=0.15", "keeper.enabled=true", "kicker.delay_s=0.03"};
  world.require_effect({world.load()});
}

TEST(ReadableFiles, AFolderOrNothingFailsWithItsReasonAndIsNoBadUsage) {
  const tests::Folder folder;
  const CLI::Validator check = readable_file();
  for (std::string file : {(folder / "none.toml").string(), folder.path().string()}) {
    EXPECT_THAT([&] { check(file); }, ThrowsMessage<std::runtime_error>(HasSubstr("cannot read " + file + ": ")));
  }
}

}  // namespace
}  // namespace trivela::cli
