// `trivela match --watch` and `trivela monitor`: what is served, what is written on the bus, what is recorded.
#include <fmt/core.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <random>

#include "tests/e2e/log_rows.hpp"
#include "tests/e2e/program.hpp"
#include "tests/pages/viewer.hpp"
#include "tests/support/folder.hpp"

namespace trivela::e2e {
namespace {

using nlohmann::json;
using pages::Viewer;
using testing::HasSubstr;
using testing::IsEmpty;

/// The port of the address that it printed first; 0: it printed none.
int port_of(const tests::Folder& folder, const Program& program) {
  wait_for_change(folder.path(), program.watch(), [&] { return program.output().find('\n') != std::string::npos; });
  const std::string text = program.output();
  const auto colon = text.find(':', text.find("//"));
  return colon == std::string::npos ? 0 : std::atoi(text.c_str() + colon + 1);
}

std::vector<std::string> match_of(const std::string& out, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"match", "--half", "stopped", "--half", "moving", "--minutes",
                                     "0.3",   "--seed", "1",       "--out",  out};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

bool is_over(const Viewer& viewer) {
  const auto match = viewer.newest.find("match");
  return match != viewer.newest.end() && match->second["over"] == true;
}

TEST(Watch, APacedAndWatchedMatchHasTheRowsOfAnyOtherAndItsPageItsCounts) {
  const tests::Folder folder;
  Program plain{"trivela", match_of("plain.db"), folder.path()};
  ASSERT_EQ(plain.wait(), 0) << plain.errors();
  Program watched{"trivela", match_of("watched.db", {"--watch", "--pace", "4"}), folder.path()};
  const int port = port_of(folder, watched);
  ASSERT_GT(port, 0) << watched.errors();
  {
    Viewer viewer(port);
    ASSERT_TRUE(wait_for_change(folder.path(), watched.watch(),
                                [&] { return watched.output().find("stays until Ctrl-C") != std::string::npos; }))
        << watched.output() << watched.errors();
    ASSERT_TRUE(viewer.wait([&] { return is_over(viewer); }));
    const json match = viewer.newest_of("match");
    const json table = match["table"]["rows"];
    EXPECT_THAT(match["alarms"], IsEmpty()) << "that its nodes have ended is no fault";
    EXPECT_EQ(match["missed"], 0);
    const Reader log{folder / "watched.db"};
    EXPECT_THAT(differences_of(Reader{folder / "plain.db"}, log), IsEmpty());
    for (const json& row : table) {
      const std::string of_policy = fmt::format(
          "SELECT count(*) FROM kicks WHERE accepted = 1 AND policy = '{}' AND coalesce(outcome, 'unknown') ",
          row["policy"].get<std::string>());
      EXPECT_EQ(row["inside"], number_of(log, of_policy + "= 'on_target'"));
      EXPECT_EQ(row["unknown"], number_of(log, of_policy + "= 'unknown'"));
      EXPECT_EQ(row["outside"], number_of(log, of_policy + "NOT IN ('on_target', 'unknown')"));
    }
    EXPECT_EQ(table.size(), 2u);
  }
  watched.signal(SIGINT);
  EXPECT_EQ(watched.wait(), 0) << watched.errors();
}

TEST(Watch, CtrlCDuringTheMatchEndsMatchAndPage) {
  const tests::Folder folder;
  Program match{"trivela", match_of("match.db", {"--watch"}), folder.path()};
  const int port = port_of(folder, match);
  ASSERT_GT(port, 0) << match.errors();
  Viewer viewer(port);
  ASSERT_TRUE(
      viewer.wait([&] { return viewer.newest.contains("pitch") && !viewer.newest["pitch"]["robots"].empty(); }));
  match.signal(SIGINT);
  EXPECT_EQ(match.wait(), 1);
  EXPECT_THAT(match.errors(), HasSubstr("interrupted"));
  EXPECT_TRUE(viewer.wait([&] { return viewer.ended; }));
  EXPECT_THAT(loose_ends_of(folder / "match.db"), IsEmpty());
}

TEST(Watch, ASecuredMatchIsWatchedByTheMonitorsIdentity) {
  const tests::Folder folder;
  Program match{"trivela", match_of("match.db", {"--watch", "--pace", "0", "--secure"}), folder.path()};
  const int port = port_of(folder, match);
  ASSERT_GT(port, 0) << match.errors();
  Viewer viewer(port);
  ASSERT_TRUE(viewer.wait([&] { return viewer.newest.contains("match") && !viewer.newest["match"]["kicks"].empty(); }))
      << match.errors();
  EXPECT_TRUE(
      viewer.wait([&] { return viewer.newest["match"]["simulated"].dump().find("a simulator") != std::string::npos; }));
}

/// A match that is paced, on a domain that is known to others.
TEST(Monitor, WritesNothingThatTrivelaTopWouldSee) {
  const tests::Folder folder;
  const std::string domain = std::to_string(1 + std::random_device{}() % 100);
  const std::string tag = fmt::format("monitor-{}-{:08x}", getpid(), std::random_device{}());
  Program monitor{"trivela", {"monitor", "--domain", domain, "--tag", tag}, folder.path()};
  const int port = port_of(folder, monitor);
  ASSERT_GT(port, 0) << monitor.errors();
  Viewer viewer(port);
  ASSERT_TRUE(viewer.wait([&] { return viewer.newest.contains("match"); }));
  Program top{
      "trivela", {"top", "--domain", domain, "--tag", tag, "--once", "--json", "--interval", "2"}, folder.path()};
  ASSERT_EQ(top.wait(), 0) << top.errors();
  const json seen = json::parse(top.output());
  EXPECT_EQ(seen["processes"].size(), 1u) << "it sees the monitor: " << seen["processes"];
  for (const json& topic : seen["topics"]) {
    EXPECT_THAT(topic["writers"], IsEmpty()) << topic;
    EXPECT_THAT(topic["readers"], IsEmpty()) << "who looks on is not counted: " << topic;
  }
  EXPECT_EQ(pages::post(port, "kick", {{"power", 50}}), 405);
  monitor.signal(SIGTERM);
  EXPECT_EQ(monitor.wait(), 0) << monitor.errors();
}

TEST(Monitor, DrawsATokenWhereOthersMayReachIt) {
  const tests::Folder folder;
  Program monitor{"trivela",
                  {"monitor", "--domain", "99", "--tag", fmt::format("token-{}", getpid()), "--listen", "0.0.0.0"},
                  folder.path()};
  ASSERT_GT(port_of(folder, monitor), 0) << monitor.errors();
  EXPECT_THAT(monitor.output(), testing::ContainsRegex("/\\?token=[0-9a-f]+\n"));
}

TEST(Watch, SaysWhatIsWrongWithItsFlags) {
  const tests::Folder folder;
  const auto refused = [&](std::vector<std::string> arguments, int code, const std::string& sentence) {
    Program program{"trivela", std::move(arguments), folder.path()};
    EXPECT_EQ(program.wait(), code);
    EXPECT_THAT(program.errors(), HasSubstr(sentence));
  };
  refused(match_of("no.db", {"--pace", "2"}), 2, "--watch");
  refused(match_of("no.db", {"--listen", "127.0.0.1"}), 2, "--watch");
  refused(match_of("no.db", {"--watch", "--pace", "2", "--devices", "emulated"}), 2, "played in real time");
  refused(match_of("no.db", {"--watch", "--pace", "nan"}), 2, "--pace");
  refused(match_of("no.db", {"--watch", "--set", "simulator.pace=2"}), 2, "--pace says it");
  refused({"monitor", "--listen", "127.0.0.1:x"}, 2, "'x' is no port");
  refused({"monitor", "--listen", "203.0.113.7"}, 1, "cannot listen on 203.0.113.7");
  refused({"monitor", "--token-file", "none"}, 2, "none: no token can be read from it");
  refused({"monitor", "--domain", "101"}, 2, "--domain");
  EXPECT_FALSE(std::filesystem::exists(folder / "no.db"));
}

}  // namespace
}  // namespace trivela::e2e
