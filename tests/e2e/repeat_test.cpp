// The seed decides a match, and no other match does.
#include <fmt/core.h>
#include <gmock/gmock.h>

#include "tests/e2e/log_rows.hpp"
#include "tests/e2e/program.hpp"
#include "tests/support/folder.hpp"

namespace trivela::e2e {
namespace {

using testing::IsEmpty;
using testing::Not;

std::vector<std::string> arguments(int seed, const std::string& out, const std::vector<std::string>& more = {}) {
  std::vector<std::string> all{
      "match", "--half", "stopped", "--half", "moving", "--minutes", "0.5", "--seed", fmt::format("{}", seed),
      "--out", out};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

void play(const tests::Folder& folder, int seed, const std::string& out, const std::vector<std::string>& more = {}) {
  Program match{"trivela", arguments(seed, out, more), folder.path()};
  ASSERT_EQ(match.wait(), 0) << match.errors();
}

TEST(Repeat, TheSameSeedGivesTheSameRowsAloneAndBesideAnotherMatch) {
  const tests::Folder folder;
  play(folder, 1, "first.db");
  play(folder, 1, "again.db");
  play(folder, 2, "other.db");
  {
    Program one{"trivela", arguments(1, "one.db"), folder.path()};
    Program two{"trivela", arguments(2, "two.db"), folder.path()};
    EXPECT_EQ(one.wait(), 0) << one.errors();
    EXPECT_EQ(two.wait(), 0) << two.errors();
  }
  const Reader first{folder / "first.db"};
  const Reader other{folder / "other.db"};
  EXPECT_GE(number_of(first, "SELECT count(*) FROM kicks"), 3);
  EXPECT_THAT(differences_of(first, Reader{folder / "again.db"}), IsEmpty());
  EXPECT_THAT(differences_of(first, other), Not(IsEmpty()));
  EXPECT_THAT(differences_of(first, Reader{folder / "one.db"}), IsEmpty()) << "while seed 2 was played";
  EXPECT_THAT(differences_of(other, Reader{folder / "two.db"}), IsEmpty()) << "while seed 1 was played";
}

TEST(Repeat, TheDecisionPathInOneProcessSaysTheSameWithKeysAndWithout) {
  const tests::Folder folder;
  play(folder, 1, "apart.db");
  play(folder, 1, "together.db", {"--set", "run.one_process=true"});
  play(folder, 1, "secured.db", {"--set", "run.one_process=true", "--secure"});
  const Reader apart{folder / "apart.db"};
  EXPECT_GE(number_of(apart, "SELECT count(*) FROM kicks"), 3);
  EXPECT_THAT(differences_of(apart, Reader{folder / "together.db"}), IsEmpty());
  EXPECT_THAT(differences_of(apart, Reader{folder / "secured.db"}), IsEmpty());
}

}  // namespace
}  // namespace trivela::e2e
