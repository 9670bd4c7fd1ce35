// The page of real logs: whatever stream is missing, the rest of it is there.
#include "evaluator/page/report_page.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>

#include "tests/evaluator/match_fixture.hpp"
#include "tests/evaluator/report_of_log.hpp"
#include "tests/evaluator/watched_log.hpp"

namespace trivela::evaluator::page {
namespace {

using testing::HasSubstr;
using testing::Not;
using Int = std::int64_t;

class ReportPageOfALog : public LogTest {
 protected:
  void write(const std::string& name = "match.db", const log::Session& of = session()) {
    MatchLog match(path(name), of, options());
    match.kicks(1, "on_target", 3);
    match.kick(1, "over");
    match.kicks(2, "on_target", 2);
    match.kick(2, "post");
    match.kick(2, "unknown");
    match.close();
  }

  std::string page_of(const std::vector<std::string>& names = {"match.db"}) const {
    std::vector<std::filesystem::path> paths;
    for (const std::string& name : names) paths.push_back(path(name));
    return report_page(make_report(log::Reader(paths.front())), paths);
  }

  void change(const std::string& sql) const {
    SQLite::Database database(path().string(), SQLite::OPEN_READWRITE);
    database.exec("DELETE FROM digests");  // what follows is not what was recorded
    database.exec("UPDATE sessions SET closed_t_ns = NULL");
    database.exec(sql);
  }
};

TEST_F(ReportPageOfALog, HasEverySectionAndTheFilesHash) {
  write();
  const std::string text = page_of();
  for (const char* const id :
       {"verdict", "table2", "forest", "mouth", "pitch", "rates", "predictions", "drift", "held", "list", "quality"})
    EXPECT_THAT(text, HasSubstr(std::string("<section id=\"") + id));
  EXPECT_THAT(text, HasSubstr("<td>match.db</td>"));
  EXPECT_THAT(text, Not(HasSubstr(directory_.path().string())));
  EXPECT_THAT(text, Not(HasSubstr("could not be made")));
  EXPECT_EQ(text, page_of());
}

TEST_F(ReportPageOfALog, NamesTheKickAtWhichAKickerChangedAndLinksToIt) {
  WatchedLog log(path(), session(), options(), 4);
  log.kicks(1, 40);
  log.kicks(1, 20, -0.7);
  log.close();
  const std::string text = page_of();
  EXPECT_THAT(text, HasSubstr(", 60 kicks: changed at kick <a href=\"#k40\">1:41</a> (+41.00 s): exit speed fell by "));
  EXPECT_THAT(text, HasSubstr("<tr id=\"k40\""));
  EXPECT_THAT(text, HasSubstr("multiply exit_speeds_mps"));
}

TEST_F(ReportPageOfALog, SaysWhatIsNotAsInTheLogThatWasRecordedBefore) {
  const auto written = [&](const std::string& name, std::int64_t day, const std::string& value) {
    log::Session played = session();
    played.uuid = "0000000" + std::to_string(day) + "-0000-4000-8000-000000000001";
    played.realtime_offset_ns = day * 86'400'000'000'000;
    played.config_toml = "### settings\n[policy]\nkeep_off_m = " + value + "\n";
    write(name, played);
  };
  written("sunday.db", 2, "3.0");
  written("saturday.db", 1, "2.5");
  const std::string text = page_of({"sunday.db", "saturday.db"});
  EXPECT_THAT(text, HasSubstr("<h3>sunday.db, after saturday.db</h3>"));
  EXPECT_THAT(text, HasSubstr("<th scope=\"row\">settings policy.keep_off_m</th><td>2.5</td><td>3.0</td>"));
}

TEST_F(ReportPageOfALog, LosesASectionAndNoReportWhereAStreamIsEmpty) {
  write();
  std::vector<std::string> tables;
  {
    const log::Reader reader(path());
    reader.query("SELECT name FROM sqlite_schema WHERE type = 'table' AND name NOT IN ('texts', 'sessions', 'digests')",
                 [&](const std::string& name) { tables.push_back(name); });
  }
  EXPECT_GT(tables.size(), 15U);
  for (const std::string& table : tables) {
    std::filesystem::remove(path());
    write();
    change("DELETE FROM " + table);
    const std::string text = page_of();
    EXPECT_THAT(text, HasSubstr("<section id=\"quality\"")) << table;
    EXPECT_THAT(text, Not(HasSubstr("could not be made"))) << table;
    EXPECT_THAT(text, HasSubstr("</html>")) << table;
  }
}

TEST_F(ReportPageOfALog, SaysWhatIsMissingWhereThereIsNoKick) {
  MatchLog match(path(), session(), options());
  match.close();
  const std::string text = page_of();
  EXPECT_THAT(text, HasSubstr("There are no kicks."));
  EXPECT_THAT(text, HasSubstr("no decision that held"));
}

TEST_F(ReportPageOfALog, ShowsKicksWithoutPlacesAsImportedOnesAre) {
  log::Session imported = session();
  imported.config_toml = "### import\nlabelled by hand\n\n";
  imported.simulated = false;
  write("match.db", imported);
  change("UPDATE kick_decisions SET distance_m = 0.0, x_m = 0.0, y_m = 0.0");
  const std::string text = page_of();
  EXPECT_THAT(text, HasSubstr("No kick says where it was taken"));
  EXPECT_THAT(text, HasSubstr("No kick says its distance."));
  EXPECT_THAT(text, HasSubstr("labelled by hand"));
  EXPECT_THAT(text, Not(HasSubstr("simulated: the")));
}

TEST_F(ReportPageOfALog, ListsTheKicksOfSeveralLogsOnce) {
  write("match.db");
  write("other.db");
  std::filesystem::copy_file(path("match.db"), path("copy.db"));
  const PageData data = read_page_data({path("match.db"), path("other.db"), path("copy.db")});
  EXPECT_EQ(data.logs.size(), 3U);
  EXPECT_EQ(data.logs[0].sha256, data.logs[2].sha256);
  EXPECT_GE(data.kicks.size(), 8U);
  for (const PageKick& kick : data.kicks) EXPECT_NE(kick.log, 2U);
  EXPECT_THAT(data.failures, testing::IsEmpty());
}

TEST_F(ReportPageOfALog, CountsChancesInWhichNobodyKicked) {
  {
    MatchLog match(path(), session(), options());
    match.kick(2, "on_target");
    const auto decisions = match.writer().table(
        "kick_decisions", {"robot_id",   "seq",           "t_ns",         "kick_id",
                           "half",       "possession_id", "policy",       "fire",
                           "reason",     "x_m",           "y_m",          "heading_rad",
                           "vx_mps",     "vy_mps",        "omega_radps",  "target_x_m",
                           "target_y_m", "target_z_m",    "distance_m",   "alpha_rad",
                           "beta_rad",   "aligned",       "left_m",       "right_m",
                           "charge",     "shadow_count",  "fire_after_s", "assignment_probability"});
    const auto shadows = match.writer().table("shadow_decisions", {"robot_id", "seq", "shadow_index", "policy", "fire",
                                                                   "reason", "aligned", "fire_after_s", "p_on_target"});
    for (Int i = 0; i < 4; ++i) {
      const bool last = i == 3;
      match.writer().push(decisions, {Int{1},
                                      500 + i,
                                      (500 + i) * 20'000'000,
                                      Int{0},
                                      Int{2},
                                      Int{77},
                                      "moving",
                                      Int{0},
                                      last ? "not_playing" : "not_aligned",
                                      last ? 9.0 : 0.5 * static_cast<double>(i),
                                      4.0,
                                      0.0,
                                      0.0,
                                      0.0,
                                      0.0,
                                      0.0,
                                      9.0,
                                      0.7,
                                      5.0,
                                      0.0,
                                      0.0,
                                      Int{0},
                                      0.3,
                                      0.3,
                                      1.0,
                                      Int{1},
                                      0.0,
                                      1.0});
      match.writer().push(shadows, {Int{1}, 500 + i, Int{0}, "stopped", Int{i == 1}, i == 1 ? "fire" : "turning",
                                    Int{0}, 0.0, i == 1 ? 0.625 : 0.875});
    }
    match.close();
  }
  const PageData data = read_page_data({path()});
  ASSERT_EQ(data.held_chances.size(), 1U);
  EXPECT_EQ(data.held_chances[0].x_m, 1.0);  // the last cycle in play
  EXPECT_TRUE(data.held_chances[0].shadow_would);
  EXPECT_EQ(data.held_chances[0].p_on_target, 0.625) << "of the cycle in which the shadow would have kicked";
  ASSERT_EQ(data.held.size(), 2U);
  EXPECT_EQ(data.held[0].reason, "not_aligned");
  EXPECT_EQ(data.held[0].cycles, 3);
  EXPECT_EQ(data.held[0].chances, 1);
  EXPECT_EQ(data.held[0].would.at("stopped").cycles, 1);
  EXPECT_EQ(data.held[0].would.at("stopped").chances, 1);
  EXPECT_EQ(data.shadows, std::vector<std::string>{"stopped"});
}

TEST_F(ReportPageOfALog, ListsTheTimeOfTheHalfOfKicksThatHaveNoReplay) {
  constexpr Int kKicks = kMostReplays + 1, kTold = 500;
  {
    MatchLog match(path(), session(), options());
    match.kicks(1, "on_target", kKicks);
    std::vector<std::string> columns = referee_columns();
    columns.emplace_back("half_time_s");
    std::vector<log::Value> cells = referee_cells(1, 1, (4 * kTold + 1) * 20'000'000, 1, true, 0);
    cells.emplace_back(61.5);
    match.writer().push(match.writer().table("referee", columns), cells);
    match.close();
  }
  const PageData data = read_page_data({path()});
  ASSERT_EQ(data.kicks.size(), kKicks);
  EXPECT_EQ(data.kicks[kTold].timeline.half_time_s, 61.5) << "the referee spoke at the instant of its decision";
  EXPECT_FALSE(data.kicks.front().timeline.half_time_s) << "he had not spoken yet";
}

TEST_F(ReportPageOfALog, RefusesAFileThatIsNoLog) {
  write();
  EXPECT_THROW(read_page_data({path("nowhere.db")}), std::runtime_error);
}

}  // namespace
}  // namespace trivela::evaluator::page
