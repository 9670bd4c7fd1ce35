// The flag that writes a report's page.
#include <gmock/gmock.h>

#include <fstream>
#include <iterator>

#include "cli/verbs.hpp"
#include "tests/cli/verb_run.hpp"
#include "tests/evaluator/match_fixture.hpp"

namespace trivela::cli {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using testing::ThrowsMessage;

class ReportPageVerb : public evaluator::LogTest {
 protected:
  ReportPageVerb() {
    evaluator::MatchLog match(path(), session(), options());
    evaluator::write_table2(match);
    match.close();
  }

  VerbRun run(const std::string& page) const {
    return run_parsed({add_report}, "report " + path().string() + " --html " + page);
  }

  static std::string text_of(const std::filesystem::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

TEST_F(ReportPageVerb, WritesAPageBesideTheText) {
  const VerbRun done = run(path("page.html").string());
  EXPECT_EQ(done.exit_code, kDone);
  EXPECT_THAT(done.out, HasSubstr("Table 2"));
  EXPECT_THAT(text_of(path("page.html")), StartsWith("<!DOCTYPE html>"));
  EXPECT_THAT(text_of(path("page.html")), HasSubstr("34/65, 52.3 %"));
}

TEST_F(ReportPageVerb, SaysFirstWhereItCannotWrite) {
  EXPECT_THAT([&] { run(path("nowhere/page.html").string()); },
              ThrowsMessage<std::runtime_error>(HasSubstr("cannot write --html")));
  EXPECT_THAT([&] { run(directory_.path().string()); }, ThrowsMessage<std::runtime_error>(HasSubstr("it is a folder")));
}

}  // namespace
}  // namespace trivela::cli
