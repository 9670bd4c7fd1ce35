// The verbs that say something of a log afterwards: label, note, doctor.
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "cli/verbs.hpp"
#include "tests/cli/verb_run.hpp"
#include "tests/evaluator/match_fixture.hpp"

namespace trivela::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using Words = std::vector<std::string>;

class AfterTheMatch : public evaluator::LogTest {
 protected:
  AfterTheMatch() {
    evaluator::MatchLog match(path(), session(), options());
    match.kicks(1, "on_target", 2);
    match.kick(1, "unknown");
    match.close();
  }

  std::string said(const Words& words) {
    const VerbRun run = run_verbs({add_label, add_note, add_doctor, add_report, add_query}, words);
    exit_code_ = run.exit_code;
    return run.out;
  }

  template <class Error>
  std::string why_refused(const Words& words) {
    try {
      said(words);
    } catch (const Error& error) {
      return error.what();
    }
    return "it was not refused";
  }

  const std::string log_ = path().string();
  int exit_code_ = -1;
};

TEST_F(AfterTheMatch, AKickIsLabelledAndTheLabelWithdrawn) {
  EXPECT_THAT(said({"label", log_}),
              AllOf(HasSubstr("1:3"), Not(HasSubstr("1:2")), HasSubstr("1 of 3 kicks are unknown")));
  EXPECT_EQ(said({"label", log_, "1:3", "wide_left", "--by", "Ada", "--note", "video 3:21"}),
            "kick 1:3 at 0.18 s (stopped): wide left, says Ada; the observer says unknown\n");
  EXPECT_EQ(exit_code_, kDone);
  EXPECT_THAT(said({"label", log_}), AllOf(HasSubstr("wide left  Ada"), HasSubstr("0 of 3 kicks are unknown")));
  EXPECT_THAT(said({"report", log_}),
              HasSubstr("hand labels: 1 kick; they disagreed with the observer in 0 of 0, who did not know 1"));
  EXPECT_THAT(said({"query", log_, "SELECT outcome, who, note FROM labels", "--csv"}),
              HasSubstr("wide_left,Ada,video 3:21"));
  EXPECT_THAT(said({"label", log_, "3", "--withdraw", "--by", "Grace"}), HasSubstr("wide left by Ada is withdrawn"));
  EXPECT_THAT(said({"label", log_}), HasSubstr("1 of 3 kicks are unknown"));
  EXPECT_THAT(why_refused<std::runtime_error>({"label", log_, "3", "--withdraw", "--by", "Grace"}),
              HasSubstr("no label by hand"));
}

TEST_F(AfterTheMatch, AKickThatAHandCallsUnknownIsCountedAsUnknownAsTheReportDoes) {
  said({"label", log_, "1:1", "unknown", "--by", "Ada"});
  EXPECT_THAT(said({"label", log_}), HasSubstr("2 of 3 kicks are unknown"));
  EXPECT_THAT(said({"report", log_, "--json"}), HasSubstr("\"unknown\": 2"));
}

TEST_F(AfterTheMatch, WhatSqliteSaysIsWhatWasLabelled) {
  said({"label", log_, "1:1", "post", "--by", "Ada"});
  const std::string ask = "sqlite3 " + log_ + " \"SELECT outcome || who FROM labels\" > " + path("said").string();
  ASSERT_EQ(std::system(ask.c_str()), 0);
  std::ifstream in(path("said"));
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "postAda");
}

TEST_F(AfterTheMatch, WhatMakesNoSenseIsRefused) {
  for (const Words& words :
       {Words{"label", log_, "1:3"}, Words{"label", log_, "1:3", "post"},
        Words{"label", log_, "1:3", "post", "--withdraw", "--by", "Ada"}, Words{"label", log_, "--by", "Ada"},
        Words{"label", log_, "1:3", "--serve"}, Words{"note", log_, "rain"},
        Words{"note", log_, "rain", "--by", "Ada", "--session", "ffff"},
        Words{"label", log_, "1:3", "post", "--by", "Ada", "--session", "ffff"}, Words{"note", log_, "--by", "Ada"},
        Words{"doctor"}})
    EXPECT_THROW(said(words), UsageError) << words[1];
  EXPECT_THROW(said({"label", log_, "1:3", "in", "--by", "Ada"}), CLI::ValidationError);
  EXPECT_THAT(why_refused<UsageError>({"label", log_, "1:9", "post", "--by", "Ada"}),
              HasSubstr("there is no kick 1:9"));
  EXPECT_THAT(said({"query", log_, "SELECT count(*) AS n FROM labels", "--csv"}), HasSubstr("n\n0\n"));
}

TEST_F(AfterTheMatch, NotesStandInTheReport) {
  EXPECT_EQ(said({"note", log_, "--match", "semi-final", "--opponent", "Them", "--venue", "Hall 3", "a post leans",
                  "--by", "Ada"}),
            log_ + ": noted of 1 session\n");
  EXPECT_THAT(said({"report", log_}),
              AllOf(HasSubstr("Match: semi-final\nOpponent: Them\nVenue: Hall 3\nNote of Ada, "),
                    HasSubstr("UTC: a post leans\n")));
  said({"note", log_, "--withdraw", "venue", "--by", "Ada"});
  EXPECT_THAT(said({"report", log_}), Not(HasSubstr("Hall 3")));
  EXPECT_THAT(said({"note", log_}),
              AllOf(HasSubstr("Venue: Hall 3 (Ada) - no longer holds"), HasSubstr("Venue: (withdrawn)")));
}

TEST_F(AfterTheMatch, WhatNobodyNotedOrWhatIsWithdrawnAlreadyIsNotWithdrawn) {
  const Words withdraw{"note", log_, "--withdraw", "venue", "--by", "Ada"};
  EXPECT_THAT(why_refused<std::runtime_error>(withdraw), HasSubstr("no venue is noted that holds"));
  said({"note", log_, "--venue", "Hall 3", "--by", "Ada"});
  said(withdraw);
  EXPECT_THAT(why_refused<std::runtime_error>(withdraw), HasSubstr("no venue is noted that holds"));
  EXPECT_THAT(said({"query", log_, "SELECT count(*) AS n FROM notes", "--csv"}), HasSubstr("n\n2\n"));
}

TEST_F(AfterTheMatch, ANoteOfOneOfTwoSessionsIsWithdrawnOfThatOneAlone) {
  {
    evaluator::MatchLog other(path("other.db"), session(), options());
    other.kicks(1, "on_target", 1);
    other.close();
  }
  const std::string both = path("both.db").string();
  run_verbs({add_merge}, {"merge", both, log_, path("other.db").string()});
  const std::string uuid =
      said({"query", both, "SELECT uuid FROM sessions ORDER BY session_id DESC LIMIT 1", "--csv"}).substr(5, 8);
  said({"note", both, "--venue", "Hall 3", "--by", "Ada", "--session", uuid});
  EXPECT_EQ(said({"note", both, "--withdraw", "venue", "--by", "Ada"}), both + ": noted of 1 session\n");
  EXPECT_THAT(said({"query", both, "SELECT count(*) AS n, count(DISTINCT session_id) AS s FROM notes", "--csv"}),
              HasSubstr("n,s\n2,1\n"));
}

TEST_F(AfterTheMatch, TheDoctorsExitCodeIsTheWorstThatHeFound) {
  EXPECT_THAT(said({"doctor", log_}), HasSubstr("ok   integrity"));
  EXPECT_EQ(exit_code_, kDone);
  {
    evaluator::MatchLog open(path("open.db"), session(), options());
    open.kicks(1, "on_target", 1);
    open.writer().flush();
    EXPECT_THAT(said({"doctor", log_, path("open.db")}),
                AllOf(HasSubstr("never closed"), HasSubstr("-> "), HasSubstr("all of them")));
    EXPECT_EQ(exit_code_, kDoneWithLoss);
  }
  std::ofstream(path("none.db")) << "none";
  EXPECT_THAT(said({"doctor", "--json", path("none.db"), log_}), HasSubstr("\"verdict\": \"bad\""));
  EXPECT_EQ(exit_code_, kFailed);
}

TEST_F(AfterTheMatch, WhileAMatchIsOnNoPageIsServed) {
  std::ofstream(path("match.toml")) << "[run]\nmatch_mode = true\n";
  EXPECT_THAT(why_refused<std::runtime_error>({"label", log_, "--serve", "--config", path("match.toml").string()}),
              HasSubstr("run.match_mode = true: a match is on, and trivela label --serve waits"));
}

/// Two sessions of one robot in one log, a kick 1:1 in each.
class OfTwoSessions : public AfterTheMatch {
 protected:
  OfTwoSessions() {
    std::int64_t kick_id = 1;
    for (const auto& [name, uuid] : {std::pair{"a.db", "aaaa0000-0000-4000-8000-000000000001"},
                                     std::pair{"b.db", "bbbb0000-0000-4000-8000-000000000001"}}) {
      log::Session played = session();
      played.uuid = uuid;
      played.seed = kick_id;  // the same seed would be the same play
      evaluator::MatchLog match(path(name), played, options());
      kick_id += std::int64_t{1} << 48;  // of a session of its own
      match.write_decision(kick_id, 1);
      match.order(kick_id);
      match.receipt(kick_id);
      match.outcome(kick_id, "on_target");
      match.close();
    }
    said({"merge", both_, path("a.db").string(), path("b.db").string()});
  }

  std::string said(const Words& words) { return run_verbs({add_label, add_note, add_merge, add_query}, words).out; }

  const std::string both_ = path("both.db").string();
};

TEST_F(OfTwoSessions, ALabelNeedsTheSessionWhereBothHaveTheKick) {
  EXPECT_THROW(said({"label", both_, "1:1", "goal", "--by", "Ada"}), UsageError);
  EXPECT_THROW(said({"label", both_, "1:1", "goal", "--by", "Ada", "--session", "cccc"}), UsageError);
  EXPECT_THAT(said({"query", both_, "SELECT count(*) AS n FROM labels", "--csv"}), HasSubstr("n\n0\n"));
  said({"label", both_, "1:1", "goal", "--by", "Ada", "--session", "bbbb"});
  EXPECT_THAT(said({"query", both_,
                    "SELECT substr(uuid, 1, 4) AS s, outcome FROM labels JOIN sessions USING (session_id)", "--csv"}),
              HasSubstr("s,outcome\nbbbb,goal\n"));
}

TEST_F(OfTwoSessions, KicksAreListedWithWhatLabelTakes) {
  said({"label", both_, "1:1", "goal", "--by", "A\nda", "--session", "bbbb"});
  EXPECT_THAT(said({"label", both_}), AllOf(HasSubstr("--session\n"), HasSubstr("A\\x0ada"),
                                            HasSubstr("bbbb0000-0000-4000-8000-000000000001\n")));
}

TEST_F(OfTwoSessions, AReportSaysOfWhichSessionANoteIs) {
  said({"note", both_, "--opponent", "Them", "--by", "Ada", "--session", "aaaa"});
  said({"note", both_, "--opponent", "Others", "--by", "Ada", "--session", "bbbb"});
  said({"note", both_, "--venue", "Hall 3", "--by", "Ada"});
  const auto report = [&](const Words& flags) {
    Words words{"report", both_};
    words.insert(words.end(), flags.begin(), flags.end());
    return run_verbs({add_report}, words).out;
  };
  EXPECT_THAT(report({}), AllOf(HasSubstr("aaaa0000 Opponent: Them\n"), HasSubstr("bbbb0000 Opponent: Others\n"),
                                HasSubstr("\nVenue: Hall 3\n")));
  EXPECT_THAT(report({"--json"}), HasSubstr("\"session\": \"aaaa0000-0000-4000-8000-000000000001\""));
}

TEST_F(OfTwoSessions, ANoteForgesNoLine) {
  said({"note", both_, "rain\naaaa0000 Opponent: Them", "--by", "A\nda"});
  EXPECT_THAT(said({"note", both_}), AllOf(HasSubstr("rain\\x0aaaaa0000"), HasSubstr("Note of A\\x0ada")));
}

TEST_F(OfTwoSessions, ANoteOfOneIsListedWithItAlone) {
  EXPECT_EQ(said({"note", both_}), "nobody has noted anything\n");
  EXPECT_EQ(said({"note", both_, "rain", "--by", "Ada", "--session", "bbbb"}), both_ + ": noted of 1 session\n");
  EXPECT_EQ(said({"note", both_, "--opponent", "Them", "--by", "Ada"}), both_ + ": noted of 2 sessions\n");
  EXPECT_THAT(said({"note", both_, "--session", "aaaa"}),
              AllOf(HasSubstr("aaaa0000 Opponent: Them (Ada)\n"), Not(HasSubstr("bbbb")), Not(HasSubstr("rain"))));
  EXPECT_THAT(said({"note", both_, "--session", "bbbb"}),
              AllOf(HasSubstr("rain"), HasSubstr("bbbb0000 Opponent: Them (Ada)\n"), Not(HasSubstr("aaaa"))));
}

TEST_F(OfTwoSessions, ANoteOfASessionThatIsNotThereIsRefused) {
  EXPECT_THROW(said({"note", both_, "rain", "--by", "Ada", "--session", "cccc"}), UsageError);
  EXPECT_THROW(said({"note", both_, "--withdraw", "referee", "--by", "Ada"}), CLI::ValidationError);
  EXPECT_EQ(said({"note", both_}), "nobody has noted anything\n");
}

TEST_F(OfTwoSessions, AWithdrawalBesideANoteGoesOnlyWhereSomethingHolds) {
  said({"note", both_, "--venue", "Hall 3", "--by", "Ada", "--session", "aaaa"});
  EXPECT_EQ(said({"note", both_, "--match", "final", "--withdraw", "venue", "--by", "Ada"}),
            both_ + ": noted of 2 sessions\n");
  EXPECT_THAT(said({"query", both_, "SELECT kind, count(*) AS n FROM notes GROUP BY kind ORDER BY kind", "--csv"}),
              HasSubstr("kind,n\nmatch,2\nvenue,2\n"));
}

}  // namespace
}  // namespace trivela::cli
