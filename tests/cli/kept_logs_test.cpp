// A match log that is named where a verb writes something else.
#include <gmock/gmock.h>

#include <fstream>
#include <iterator>

#include "cli/verbs.hpp"
#include "tests/cli/verb_run.hpp"
#include "tests/evaluator/match_fixture.hpp"

namespace trivela::cli {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

class KeptLogs : public evaluator::LogTest {
 protected:
  KeptLogs() {
    for (const char* const name : {"match.db", "other.db"}) {
      evaluator::MatchLog match(path(name), session(), options());
      evaluator::write_table2(match);
      match.close();
    }
    std::filesystem::create_symlink("other.db", path("link"));
  }

  std::string file(const std::string& name) const { return path(name).string(); }
  std::string bytes_of(const std::string& name) const {
    std::ifstream in(path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

TEST_F(KeptLogs, AreNeverOverwrittenByWhatElseAVerbWrites) {
  const std::string match = bytes_of("match.db"), other = bytes_of("other.db");
  const std::string log = file("match.db");
  for (const std::string& target : {file("match.db"), file("other.db"), file("link")}) {
    for (const std::string& words :
         {"report " + log + " --html " + target, "report " + log + " --json --out " + target,
          "compare " + log + " --out " + target, "export " + log + " --mcap " + target + " --force",
          "study frontier --matches 2 --csv " + target, "study factorial --matches 2 --svg " + target,
          "study tune moving --matches 2 --out " + target, "study learn " + log + " --out " + target}) {
      EXPECT_THAT(
          [&] {
            run_parsed({add_report, add_compare, add_export, add_study}, words);
          },
          ThrowsMessage<std::runtime_error>(
              HasSubstr(target + " holds a database, such as a match log, and is never overwritten")))
          << words;
      EXPECT_TRUE(bytes_of("match.db") == match && bytes_of("other.db") == other) << words;
    }
  }
}

}  // namespace
}  // namespace trivela::cli
