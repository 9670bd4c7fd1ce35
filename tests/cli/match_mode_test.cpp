// While a match is on, no verb that moves a robot or takes orders from a page begins.
#include <gmock/gmock.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "cli/verbs.hpp"
#include "tests/cli/verb_run.hpp"
#include "tests/support/folder.hpp"

namespace trivela::cli {
namespace {

using testing::HasSubstr;

class WhileAMatchIsOn : public testing::Test {
 protected:
  WhileAMatchIsOn() { std::ofstream(folder_ / "match.toml") << "[run]\nmatch_mode = true\n"; }

  std::string why_refused(AddVerb verb, std::vector<std::string> words) const {
    words.insert(words.end(), {"--config", (folder_ / "match.toml").string()});
    try {
      run_verbs({verb}, words);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "it was not refused";
  }

  tests::Folder folder_;
};

TEST_F(WhileAMatchIsOn, NoWheelIsTurnedAndNoTestKickGiven) {
  EXPECT_THAT(why_refused(add_hardware, {"hardware", "--spin", "1"}),
              HasSubstr("run.match_mode = true: a match is on, and a wheel's test waits"));
  EXPECT_THAT(why_refused(add_hardware, {"hardware", "--kick", "--armed"}),
              HasSubstr("run.match_mode = true: a match is on, and a test kick waits"));
}

TEST_F(WhileAMatchIsOn, NoCalibrationOfCalibrationBegins) {
  EXPECT_THAT(why_refused(add_calibrate,
                          {"calibrate", "run", "--in", "field", "--robot", "r", "--out-dir", folder_.path().string()}),
              HasSubstr("run.match_mode = true: a match is on, and the calibration on a field waits"));
}

TEST_F(WhileAMatchIsOn, NoPageOfLobsIsServed) {
  const std::string record = folder_ / "record.db";
  EXPECT_THAT(why_refused(add_lob, {"lob", "--live", "tcp://127.0.0.1:1", "--record", record}),
              HasSubstr("run.match_mode = true: a match is on, and the page of trivela lob waits"));
  EXPECT_THAT(why_refused(add_lob, {"lob", "--replay", record}), HasSubstr("the page of trivela lob waits"));
  EXPECT_FALSE(std::filesystem::exists(record));
}

}  // namespace
}  // namespace trivela::cli
