#include "evaluator/counting/metrics.hpp"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "kicking/policy/policy.hpp"
#include "log/write/additions.hpp"
#include "tests/evaluator/match_fixture.hpp"

namespace trivela::evaluator {
namespace {

using testing::HasSubstr;

using Int = std::int64_t;
constexpr Int kSecond_ns = 1'000'000'000;

/// A kick of the moving policy in whose cycle the predictive one gave its chance.
void write_predicted_kick(MatchLog& match) {
  log::Writer& writer = match.writer();
  const auto decisions = writer.table("kick_decisions", {"robot_id",     "seq",
                                                         "t_ns",         "kick_id",
                                                         "half",         "possession_id",
                                                         "policy",       "fire",
                                                         "reason",       "x_m",
                                                         "y_m",          "heading_rad",
                                                         "vx_mps",       "vy_mps",
                                                         "omega_radps",  "target_x_m",
                                                         "target_y_m",   "target_z_m",
                                                         "distance_m",   "alpha_rad",
                                                         "beta_rad",     "aligned",
                                                         "left_m",       "right_m",
                                                         "charge",       "shadow_count",
                                                         "fire_after_s", "assignment_probability",
                                                         "power",        "opponent_distance_m"});
  writer.push(decisions, {Int{1},   Int{1000}, 50 * kSecond_ns,
                          Int{99},  Int{2},    Int{99},
                          "moving", Int{1},    "fire",
                          0.0,      4.0,       0.0,
                          0.5,      1.0,       0.25,
                          0.0,      9.0,       0.7,
                          5.0,      0.0,       0.0,
                          Int{1},   0.3,       0.3,
                          1.0,      Int{1},    0.0,
                          1.0,      20.0,      2.5});
  const auto shadows = writer.table("shadow_decisions", {"robot_id", "seq", "shadow_index", "policy", "fire", "reason",
                                                         "aligned", "p_on_target", "fire_after_s"});
  writer.push(shadows, {Int{1}, Int{1000}, Int{0}, "predictive", Int{0}, "waiting", Int{1}, 0.625, 0.0});
  writer.push(shadows, {Int{1}, Int{999}, Int{0}, "stopped", Int{1}, "fire", Int{0}, log::Value{}, 0.0});
  writer.push(decisions, {Int{1},   Int{999}, 49 * kSecond_ns,
                          Int{0},   Int{2},   Int{99},
                          "moving", Int{0},   "not_aligned",
                          0.0,      3.5,      0.0,
                          0.5,      1.0,      0.25,
                          0.0,      9.0,      0.7,
                          5.5,      0.0,      0.0,
                          Int{0},   0.3,      0.3,
                          1.0,      Int{0},   0.0,
                          1.0,      20.0,     2.5});
  match.order(99);
  match.receipt(99);
  match.outcome(99, "on_target");
}

/// A possession of which the truth and the assignment are noted, its ball in flight, and a stream that fell silent.
void write_surroundings(MatchLog& match) {
  log::Writer& writer = match.writer();
  writer.push(writer.table("possession_truths", {"robot_id", "seq", "t_ns", "half", "possession_id", "ending",
                                                 "start_t_ns", "start_x_m", "start_y_m", "start_heading_rad"}),
              {Int{1}, Int{1}, 51 * kSecond_ns, Int{2}, Int{99}, "kicked", 49 * kSecond_ns, 0.5, 4.0, 0.0});
  writer.push(writer.table("assignments", {"robot_id", "half", "possession_id", "policy", "probability"}),
              {Int{1}, Int{2}, Int{99}, "moving", 0.5});
  writer.push(writer.table("flight_frames", {"robot_id", "seq", "t_ns", "t_exposure_ns", "ball_seen", "ball_x_m",
                                             "ball_y_m", "ball_z_m"}),
              {Int{1}, Int{1}, 50 * kSecond_ns + 30, 50 * kSecond_ns + 10, Int{1}, 0.25, 6.0, 0.5});
  const auto estimates = kicker_estimates(writer);
  writer.push(estimates,
              {Int{1}, Int{1}, 1 * kSecond_ns, Int{0}, Int{0}, Int{0}, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.5, 0.5, 0.5, 0.5,
               0.5,    0.5,    0.25,           0.25,   0.25,   0.25,   0.0, 0.0, 0.0});
  writer.push(estimates, {Int{1},  Int{2}, 52 * kSecond_ns,
                          Int{99}, Int{1}, Int{0},
                          0.125,   0.25,   0.375,
                          0.5,     0.625,  0.75,
                          0.25,    0.25,   0.25,
                          0.25,    0.25,   0.25,
                          0.25,    0.25,   0.25,
                          0.25,    0.125,  0.0625,
                          4.5});
  writer.silence({"odometry", 1, 12 * kSecond_ns, 13 * kSecond_ns});
}

/// A label of the first kick.
void say_afterwards(const std::filesystem::path& path) {
  Int session_id = 0, t_ns = 0;
  log::Reader(path).query("SELECT session_id, t_ns FROM kicks WHERE kick_id = 1", [&](Int of, Int at) {
    session_id = of;
    t_ns = at;
  });
  log::Additions(path).add(log::Label{session_id, 1, 1, t_ns, "saved", "Ada", "video 12:34"}, kSecond_ns);
}

/// A match in which every metric finds something.
void write_known_match(const std::filesystem::path& path, log::Session session, log::WriterOptions options) {
  session.uuid = "00000000-0000-4000-8000-000000000001";
  MatchLog match(path, session, std::move(options));
  match.referee(0.0, 1, true);
  match.status(0, 0);
  match.kicks(1, "on_target", 2);
  match.kicks(1, "wide_left", 1);
  match.truth(match.kick(1, "on_target"), "on_target", true);
  match.referee(40.0, 1, false);
  match.referee(45.0, 2, true);
  match.kicks(2, "on_target", 3);
  match.truth(match.kick(2, "over"), "bar");
  match.kick(2, "unknown");
  const Int refused = match.decide(2);
  match.order(refused);
  match.receipt(refused, "charging");
  match.decide(2);  // of which nothing else is in the log
  write_predicted_kick(match);
  write_surroundings(match);
  match.status(12, 1);
  match.referee(60.0, 2, false);
  const auto statuses = match.writer().table(
      "kicker_status", {"robot_id", "seq", "t_ns", "charge", "armed", "ready", "fault", "last_kick_id", "last_accepted",
                        "orders_handled", "orders_refused", "state", "charge_modelled"});
  for (const Int seq : {2000, 2001}) {  // the second a second before the first
    match.writer().push(statuses, {Int{1}, seq, (2070 - seq) * kSecond_ns, 1.0, Int{1}, Int{1}, "none", Int{0}, Int{0},
                                   Int{12}, Int{1}, "ready", Int{0}});
  }
  match.close();
  say_afterwards(path);
}

std::string cell_text(const log::Value& cell) {
  if (const auto* const whole = std::get_if<Int>(&cell)) return fmt::to_string(*whole);
  if (const auto* const number = std::get_if<double>(&cell)) return fmt::to_string(*number);
  if (const auto* const text = std::get_if<std::string>(&cell)) return *text;
  return "NULL";
}

/// Head and rows of the answer, a line each.
std::string answer(const log::Reader& reader, const std::string& sql) {
  std::string text;
  reader.ask(
      sql, [&](const std::vector<std::string>& names) { text = fmt::format("{}\n", fmt::join(names, ",")); },
      [&](std::span<const log::Value> row) {
        std::vector<std::string> cells;
        for (const log::Value& cell : row) cells.push_back(cell_text(cell));
        text += fmt::format("{}\n", fmt::join(cells, ","));
      });
  return text;
}

/// What tests/evaluator/metrics/NAME.csv has of the known match.
std::string known_table(std::string_view name) {
  std::ostringstream table;
  table << std::ifstream(fmt::format("{}/tests/evaluator/metrics/{}.csv", TRIVELA_SOURCE_DIR, name)).rdbuf();
  return table.str();
}

class MetricOfTheKnownMatch : public LogTest, public testing::WithParamInterface<Metric> {
 protected:
  MetricOfTheKnownMatch() { write_known_match(path(), session(), options()); }
};

TEST_P(MetricOfTheKnownMatch, IsItsTable) {
  const std::string said = answer(log::Reader(path()), std::string(GetParam().sql));
  EXPECT_EQ(said, known_table(GetParam().name));
  EXPECT_GE(std::ranges::count(said, '\n'), 2) << "the known match has nothing of it";
}

INSTANTIATE_TEST_SUITE_P(Each, MetricOfTheKnownMatch, testing::ValuesIn(metrics().begin(), metrics().end()),
                         [](const auto& of) { return std::string(of.param.name); });

class CarriedKicks : public LogTest {
 protected:
  std::string by_the_rule(const std::string& carry_limit_m) {
    log::Session ruled = session();
    ruled.config_toml =
        "### settings\n[rules]\ncarry_limit_m = " + carry_limit_m + "\n\n### robot\nball_offset_m = 0.27\n";
    write_known_match(path(), ruled, options());
    const std::string said = answer(log::Reader(path()), std::string(metric("carried_kicks")->sql));
    return said.substr(said.find("8192,1,99,"));
  }
};

TEST_F(CarriedKicks, BeyondTheSessionsLimitAreTooFar) {
  EXPECT_EQ(by_the_rule("0.4"), "8192,1,99,moving,carried_too_far,0.5,0.4,1\n");
}

TEST_F(CarriedKicks, WithinTheSessionsLimitAreNot) {
  EXPECT_EQ(by_the_rule("3.0"), "8192,1,99,moving,on_target,0.5,3,0\n");
}

TEST_F(CarriedKicks, OfRulesWithoutALimitAreNeverTooFar) {
  EXPECT_EQ(by_the_rule("0.0"), "8192,1,99,moving,on_target,0.5,NULL,0\n");
}

TEST(Metrics, SayTheirColumnsInTheirHead) {
  EXPECT_GE(metrics().size(), 17u);
  for (const Metric& metric : metrics()) {
    const std::string said = metric.explanation();
    const std::string columns = said.substr(std::min(said.find("\nColumns: "), said.size()));
    std::istringstream head(known_table(metric.name));
    std::string names, name;
    std::getline(head, names);
    for (std::istringstream line(names); std::getline(line, name, ',');)
      EXPECT_THAT(columns, HasSubstr(name)) << metric.name;
  }
}

TEST(Metrics, AreFoundByTheirName) {
  EXPECT_EQ(metric("silences")->name, "silences");
  EXPECT_FALSE(metric("silence"));
}

class Question : public LogTest {
 protected:
  Question() { write_known_match(path(), session(), options()); }

  std::string refusal(const std::string& sql) const {
    try {
      answer(log::Reader(path()), sql);
      return "answered";
    } catch (const log::BadQuestion& bad) {
      return bad.what();
    }
  }
};

TEST_F(Question, IsAnsweredFromTablesAndViews) {
  const log::Reader reader(path());
  EXPECT_EQ(answer(reader, "SELECT count(*) AS n, NULL AS none, 0.5 AS half FROM counted_kicks;"),
            "n,none,half\n12,NULL,0.5\n");
  EXPECT_EQ(answer(reader,
                   "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < 3) "
                   "SELECT i FROM n -- three of them"),
            "i\n1\n2\n3\n");
}

TEST_F(Question, HasThePoliciesInTheOrderOfTheRegistry) {
  std::string order = "policy\n";
  for (const std::string& policy : kicking::policies_where([](const auto&) { return true; })) order += policy + "\n";
  EXPECT_EQ(answer(log::Reader(path()), "SELECT policy FROM policy_order ORDER BY place"), order);
}

TEST_F(Question, ThatWouldChangeSomethingIsRefused) {
  const std::string other = path("other.db").string();
  for (const std::string& sql :
       {std::string("DELETE FROM referee"), "ATTACH '" + other + "' AS other",
        std::string("PRAGMA writable_schema = 1"), std::string("CREATE TABLE t (x)"),
        std::string("INSERT INTO temp.left_out_sessions VALUES (1)"), "VACUUM INTO '" + other + "'"})
    EXPECT_THAT(refusal(sql), HasSubstr("only read")) << sql;
  EXPECT_FALSE(std::filesystem::exists(other));
}

TEST_F(Question, ThatIsNoneOrTwoOrWrongIsRefusedWithTheReason) {
  EXPECT_EQ(refusal(""), "it asks nothing");
  EXPECT_EQ(refusal(" -- only a remark"), "it asks nothing");
  EXPECT_EQ(refusal("SELECT 1; SELECT 2"), "it is more than one statement");
  EXPECT_THAT(refusal("SELECT speed FROM referee"), HasSubstr("no such column: speed"));
  EXPECT_THAT(refusal("SELEKT 1"), HasSubstr("syntax error"));
}

TEST_F(Question, LeavesTheReaderAsItWas) {
  log::Reader reader(path());
  EXPECT_THROW(answer(reader, "DELETE FROM referee"), log::BadQuestion);
  EXPECT_NO_THROW(reader.leave_out({1}, {})) << "which writes into a table of the connection";
  EXPECT_EQ(reader.kicks().size(), 12u);
}

}  // namespace
}  // namespace trivela::evaluator
