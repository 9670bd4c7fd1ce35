#include <fmt/format.h>
#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/import/kick_labels.hpp"
#include "cli/verbs.hpp"
#include "tests/cli/verb_run.hpp"
#include "tests/evaluator/log_fixture.hpp"

namespace trivela::cli {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

const std::string kTable2 = std::string(TRIVELA_SOURCE_DIR) + "/config/labels/paper_table2.csv";

class ImportKicks : public evaluator::LogTest {
 protected:
  std::string run(const std::string& words) {
    const VerbRun run = run_verbs({add_import, add_report, add_compare}, words);
    exit_code_ = run.exit_code;
    return run.out;
  }

  std::string import(const std::string& name, const std::string& csv) {
    std::ofstream(path(name + ".csv")) << csv;
    const std::string log = path(name + ".db").string();
    run("import kicks " + path(name + ".csv").string() + " --out " + log);
    return log;
  }

  int exit_code_ = -1;
};

TEST_F(ImportKicks, ThePapersKicksAreItsTable2) {
  const std::string log = path().string();
  EXPECT_THAT(run("import kicks " + kTable2 + " --out " + log),
              HasSubstr("197 kicks, labelled by the paper's authors"));
  const std::string report = run("report " + log);
  EXPECT_EQ(exit_code_, kDone);
  EXPECT_THAT(report, HasSubstr("outcomes labelled by hand, by the paper's authors: 197 kicks of paper_table2.csv"));
  EXPECT_THAT(report, HasSubstr("stopped      34       31        0      52.3 %  40.4 % to 64.0 %"));
  EXPECT_THAT(report, HasSubstr("moving      100       32        0      75.8 %  67.8 % to 82.3 %"));
  EXPECT_THAT(report, HasSubstr("unclosed kicks: none"));
  EXPECT_THAT(report, Not(HasSubstr("SIMULATED")));
  EXPECT_THAT(report, Not(HasSubstr("sightings")));
  const auto json = nlohmann::json::parse(run("report --json " + log));
  EXPECT_EQ(json["simulated"], false);
  EXPECT_EQ(json["policies"][0]["misses"]["outside"], 31);
  EXPECT_THAT(json["sessions"][0]["imported"][0], HasSubstr("by the paper's authors"));
}

TEST_F(ImportKicks, ThePapersKicksAreComparedAsItsCountsAre) {
  const std::string log = path().string();
  run("import kicks " + kTable2 + " --out " + log);
  const std::string compared = run("compare --all " + log);
  EXPECT_THAT(compared, HasSubstr("+23.4 percentage points, 95 % +9.3 to +37.0"));
  EXPECT_THAT(compared, HasSubstr("Outcomes: as somebody labelled them."));
  EXPECT_THAT(compared, HasSubstr("labels by hand do not say how the policies were assigned"));
  EXPECT_THAT(run("compare --all --stratify distance " + log), HasSubstr("197 kicks left out below"));
}

TEST_F(ImportKicks, ReasonsTimesHalvesAndRobotsAreKept) {
  const std::string log = import("a",
                                 "by,outcome,policy,time,half,robot\nAnna,post,moving,1:02:03.5,2,4\n"
                                 "Ben,unknown,stopped,,1,\nAnna,inside,moving,83.25,,2\nBen,outside,moving,,,\n");
  const log::Reader reader(log);
  const auto kicks = reader.kicks();
  ASSERT_EQ(kicks.size(), 4u);
  std::vector<std::string> seen;
  for (const log::Kick& kick : kicks) {
    seen.push_back(fmt::format("{} {} {} {} {}", kick.robot_id, kick.half, kick.policy, kick.observed->outcome,
                               kick.t_ns / 1'000'000));
  }
  EXPECT_THAT(seen, testing::UnorderedElementsAre("4 2 moving post 3723500", "0 1 stopped unknown 3723500",
                                                  "2 1 moving on_target 83250", "0 1 moving unknown 83250"));
  const std::string report = run("report " + log);
  EXPECT_THAT(report, HasSubstr("by Anna, Ben: 4 kicks of a.csv"));
  EXPECT_THAT(report, HasSubstr("2 of them with a time"));
  EXPECT_THAT(report, HasSubstr("stopped       0        0        1"));
  EXPECT_THAT(report, HasSubstr("moving        1        2        0"));
  EXPECT_THAT(reader.whole(reader.sessions().front()).config_toml, HasSubstr("Ben,outside,moving,,,\n"));
}

TEST_F(ImportKicks, FilesAreMatchesAndTheSameFileCountsOnce) {
  const std::string head = "time,policy,outcome,by\n";
  std::string stopped = head, moving = head;
  for (int i = 0; i < 30; ++i) {
    stopped += i < 15 ? ",stopped,inside,A\n" : ",stopped,outside,A\n";
    moving += i < 25 ? ",moving,inside,A\n" : ",moving,over,A\n";
  }
  const std::string a = import("a", stopped), b = import("b", moving);
  const std::string both = run("compare --all " + a + " " + b);
  EXPECT_THAT(both, HasSubstr("+33.3 percentage points"));
  run("import kicks " + path("b.csv").string() + " --out " + path("again.db").string());
  const std::string again = run("compare --all " + a + " " + b + " " + path("again.db").string());
  EXPECT_THAT(again, HasSubstr("1 of its sessions stands in an earlier log, too"));
  EXPECT_THAT(again, HasSubstr("+33.3 percentage points"));
  const auto json = nlohmann::json::parse(run("compare --all --json " + a + " " + b));
  EXPECT_EQ(json["outcome"], "labelled");
}

std::string refusal_of(const std::string& rows, const std::string& head = "time,policy,outcome,by") {
  std::istringstream in(head + "\n" + rows);
  try {
    read_kick_labels(in, "k.csv");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(KickLabels, BadRowsAreRefusedWithFileLineColumnAndValue) {
  EXPECT_EQ(refusal_of(",moving,inside,A\n"), "");
  EXPECT_EQ(refusal_of(",moving,inside,A\n,moving,in,A\n"),
            "k.csv:3: column outcome: 'in' is none of goal, saved, inside, outside, unknown, wide_left, wide_right, "
            "over, short, "
            "post, bar, blocked");
  EXPECT_THAT(refusal_of(",fast,inside,A\n"), HasSubstr("k.csv:2: column policy: 'fast' is none of stopped, moving"));
  EXPECT_THAT(refusal_of(",turn_drive,inside,A\n"), HasSubstr("column policy: 'turn_drive' is none of"));
  EXPECT_EQ(refusal_of(",moving,inside,\n"), "k.csv:2: column by: is empty");
  EXPECT_EQ(refusal_of(",moving,,A\n"), "k.csv:2: column outcome: is empty");
  for (const char* const time : {"-1", "1:60", "1:2:3:4", "0.5:10", "nan", "1:", "ten", "90000", ":5"})
    EXPECT_THAT(refusal_of(std::string(time) + ",moving,inside,A\n"), HasSubstr(std::string("column time: '") + time));
  EXPECT_THAT(refusal_of(",moving,inside\n"), HasSubstr("k.csv:2: column by: is missing"));
  const std::string more = "time,policy,outcome,by,half,robot";
  EXPECT_EQ(refusal_of(",moving,inside,A,5,\n", more), "k.csv:2: column half: '5' is not from 1 to 4");
  EXPECT_EQ(refusal_of(",moving,inside,A,0,\n", more), "k.csv:2: column half: '0' is not from 1 to 4");
  EXPECT_EQ(refusal_of(",moving,inside,A,4,\n", more), "");
  EXPECT_EQ(refusal_of(",moving,inside,A,1,1.5\n", more), "k.csv:2: column robot: '1.5' is not whole");
}

TEST(KickLabels, FilesOfOtherColumnsAreRefused) {
  EXPECT_EQ(refusal_of("", ""), "k.csv: no header line");
  EXPECT_EQ(refusal_of(""), "k.csv: no kick in it");
  EXPECT_EQ(refusal_of("", "time,policy,outcome"), "k.csv: no column by in the header (time, policy, outcome)");
  EXPECT_THAT(refusal_of("", "time,policy,outcome,by,distance"), HasSubstr("column distance means nothing here"));
  EXPECT_THAT(refusal_of("", "time,policy,outcome,by,by"), HasSubstr("column by stands twice in the header"));
}

}  // namespace
}  // namespace trivela::cli
