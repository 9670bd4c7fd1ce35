// What a real-time match says of a node that stands still and of a recorder that is killed, against a witness outside:
// another listener on the bus, who hears the streams and the coil for himself.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <initializer_list>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <utility>

#include "bus/domain/domain.hpp"
#include "bus/reader.hpp"
#include "config/settings.hpp"
#include "idl/messages.hpp"
#include "tests/e2e/log_rows.hpp"
#include "tests/e2e/program.hpp"
#include "tests/support/folder.hpp"

namespace trivela::e2e {
namespace {

using Clock = std::chrono::steady_clock;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

config::Settings settings_for(const tests::Folder& folder) {
  const std::filesystem::path shipped = std::filesystem::path{TRIVELA_SOURCE_DIR} / "config/default.toml";
  config::Settings settings = config::load_settings(shipped);
  std::random_device random;
  settings.run.lockstep = false;
  settings.domain.domain_id = 1 + random() % 100;
  settings.domain.tag = fmt::format("silence-{}-{:08x}", getpid(), random());
  settings.simulator.halves = 1;
  settings.simulator.half_minutes = 30;  // ended by the test
  settings.kick_decision.policy_by_half = {kicking::PolicyName::kMoving};
  settings.recorder.log = folder / "match.db";
  return settings;
}

/// Hears odometry, the referee and the coil.
class Witness {
 public:
  explicit Witness(const config::Domain& domain)
      : participant_(bus::loopback(domain.domain_id, domain.tag)),
        odometry_(participant_, everything()),
        referee_(participant_, everything()),
        fire_(participant_, everything()) {}

  /// Listens until `met`; false if that does not happen.
  template <class Condition>
  bool hears_until(const Condition& met) {
    const auto deadline = Clock::now() + kTimeout;
    while (!met() && Clock::now() < deadline) {
      referee_.wait(std::chrono::milliseconds{20});
      odometry_.take([&](const msg::Odometry& sample) { odometry_t_ns.push_back(sample.t_ns); });
      referee_.take([&](const msg::Referee& word) { referee_t_ns = word.t_ns; });
      fire_.take([&](const msg::DeviceFire& fire) {
        if (fire.withdrawn) {
          fires.erase(fire.kick_id);
        } else {
          fires.insert(fire.kick_id);
        }
      });
    }
    return met();
  }

  /// Listens until so many more kicks, and then for half a second of the match: nothing of them is under way any more.
  bool hears_kicks(std::size_t more) {
    const std::size_t until = fires.size() + more;
    if (!hears_until([&] { return fires.size() >= until; })) return false;
    const std::int64_t kicked_t_ns = referee_t_ns;
    return hears_until([&] { return referee_t_ns > kicked_t_ns + 500'000'000; });
  }

  std::vector<std::int64_t> odometry_t_ns;
  std::int64_t referee_t_ns = 0;
  std::set<std::int64_t> fires;  ///< ids of the kicks that the coil was told and not told off

 private:
  static bus::ReaderOptions everything() {
    bus::ReaderOptions options;
    options.keep_all = true;
    return options;
  }

  bus::Participant participant_;
  bus::Reader<msg::Odometry> odometry_;
  bus::Reader<msg::Referee> referee_;
  bus::Reader<msg::DeviceFire> fire_;
};

/// All nodes of a real-time match, in a folder.
class Match {
 public:
  Match() {
    std::ofstream{folder / "nodes.toml"} << config::to_toml_text(settings);
    start("recorder");
    EXPECT_TRUE(wait_for_change(folder.path(), node("recorder").watch(), [&] { return exists(folder / "match.db"); }));
    for (const char* const name : {"odometry", "world_state", "kick_decision", "kicker_driver", "shot_observer"}) {
      start(name);
      EXPECT_TRUE(wait_for_change(folder.path(), node(name).watch(), [&] { return !node(name).errors().empty(); }));
    }
    start("simulator");
  }

  Program& node(const std::string& name) { return *nodes_.at(name); }
  void start(const std::string& name) {
    nodes_[name] =
        std::make_unique<Program>("trivela-" + name, std::vector<std::string>{"--config", "nodes.toml"}, folder.path());
  }
  void stop(const std::string& name) {
    node(name).signal(SIGTERM);
    EXPECT_EQ(node(name).wait(), 0) << name << ": " << node(name).errors();
  }
  void stop_all() {
    for (const char* const name :
         {"simulator", "odometry", "world_state", "kick_decision", "kicker_driver", "shot_observer", "recorder"})
      stop(name);
  }
  /// What `trivela report --json` says of a log and with which exit code.
  nlohmann::json report(const std::string& log, int& code) const {
    Program report{"trivela", {"report", log, "--json"}, folder.path()};
    code = report.wait();
    return nlohmann::json::parse(report.output());
  }

  tests::Folder folder;
  config::Settings settings = settings_for(folder);
  Witness witness{settings.domain};

 private:
  std::map<std::string, std::unique_ptr<Program>> nodes_;
};

/// The longest time between two of these instants, one after the other: from and to.
std::pair<std::int64_t, std::int64_t> longest_gap(const std::vector<std::int64_t>& t_ns) {
  std::int64_t from = 0, to = 0;
  for (std::size_t i = 1; i < t_ns.size(); ++i) {
    if (t_ns[i] - t_ns[i - 1] <= to - from) continue;
    from = t_ns[i - 1];
    to = t_ns[i];
  }
  return {from, to};
}

std::int64_t length_ns(const std::pair<std::int64_t, std::int64_t>& gap) { return gap.second - gap.first; }

/// The kicks that a driver accepted, by these logs.
std::set<std::int64_t> accepted_in(std::initializer_list<const Reader*> logs) {
  std::set<std::int64_t> kicks;
  for (const Reader* log : logs)
    for (const Row& row : rows_of(*log, "SELECT kick_id FROM kick_receipts GROUP BY kick_id HAVING min(accepted) = 1"))
      kicks.insert(std::get<std::int64_t>(row[0]));
  return kicks;
}

TEST(Silence, ANodeThatStandsStillIsWarnedOfLoggedAndReported) {
  Match match;
  Witness& witness = match.witness;
  ASSERT_TRUE(witness.hears_until([&] { return witness.odometry_t_ns.size() > 50; }));
  // Until the witness hears a gap of a second: who goes on may say some of what waited for it meanwhile.
  for (int attempt = 0; attempt < 5 && length_ns(longest_gap(witness.odometry_t_ns)) <= 1'000'000'000; ++attempt) {
    match.node("odometry").signal(SIGSTOP);
    const std::int64_t stopped_t_ns = witness.referee_t_ns;
    // The rest of the match goes on; not until 0.5 or 1.5 s, when readers that hear nothing are made again.
    ASSERT_TRUE(witness.hears_until([&] { return witness.referee_t_ns > stopped_t_ns + 1'250'000'000; }));
    const std::size_t before = witness.odometry_t_ns.size();
    match.node("odometry").signal(SIGCONT);
    ASSERT_TRUE(witness.hears_until([&] { return witness.odometry_t_ns.size() > before + 50; }));
  }
  match.stop_all();

  EXPECT_THAT(match.node("world_state").errors(), HasSubstr("no odometry for 0."));
  EXPECT_THAT(match.node("world_state").errors(), HasSubstr("odometry back after "));
  EXPECT_THAT(match.node("odometry").errors(), HasSubstr("this process stood still for "));
  EXPECT_THAT(match.node("recorder").errors(), HasSubstr("no odometry of robot 1 for 0."));

  // The longest gap that the witness heard is a row with his own times, up to samples that the log says it missed.
  const std::pair received = longest_gap(witness.odometry_t_ns);
  ASSERT_GT(length_ns(received), 1'000'000'000);
  const Reader log{match.folder / "match.db"};
  const auto silence = rows_of(log,
                               "SELECT from_t_ns, to_t_ns FROM losses WHERE stream = 'odometry' AND robot_id = 1 "
                               "ORDER BY to_t_ns - from_t_ns DESC LIMIT 1");
  ASSERT_THAT(silence, SizeIs(1));
  const auto from = std::get<std::int64_t>(silence[0][0]), to = std::get<std::int64_t>(silence[0][1]);
  EXPECT_LE(from, received.first);
  EXPECT_GE(to, received.second);
  const auto missed = std::ranges::count_if(witness.odometry_t_ns, [&](auto t_ns) { return from < t_ns && t_ns < to; });
  EXPECT_LE(missed, number_of(log, "SELECT sum(lost + gaps) FROM losses WHERE stream = 'odometry' AND robot_id = 0"))
      << fmt::format("{}", fmt::join(losses_of(log), "\n"));
  EXPECT_EQ(number_of(log,
                      "SELECT sum(received + missing) FROM (SELECT received, lost + gaps + overflow + nan_refused "
                      "+ rejected AS missing FROM losses WHERE robot_id > 0)"),
            0)
      << "silences are not counted as samples";

  int code = 0;
  const auto json = match.report("match.db", code);
  EXPECT_EQ(code, 3);
  bool shown = false;
  for (const auto& row : json.at("data_quality").at("silences"))
    shown = shown || (row.at("stream") == "odometry" && row.at("from_t_ns") == from && row.at("to_t_ns") == to);
  EXPECT_TRUE(shown) << json.at("data_quality");
  Program text{"trivela", {"report", "match.db"}, match.folder.path()};
  text.wait();
  EXPECT_THAT(text.output(), HasSubstr("odometry of robot 1 silent from "));
}

// Beyond what waits in its socket meanwhile: the numbers tell how many were lost.
TEST(Silence, ARecorderThatStoodStillForLongCountsEveryRowThatIsMissing) {
  Match match;
  Witness& witness = match.witness;
  ASSERT_TRUE(witness.hears_until([&] { return witness.odometry_t_ns.size() > 50; }));
  match.node("recorder").signal(SIGSTOP);
  const std::int64_t stopped_t_ns = witness.referee_t_ns;
  ASSERT_TRUE(witness.hears_until([&] { return witness.referee_t_ns > stopped_t_ns + 16'000'000'000; }));
  match.node("recorder").signal(SIGCONT);
  const std::size_t before = witness.odometry_t_ns.size();
  ASSERT_TRUE(witness.hears_until([&] { return witness.odometry_t_ns.size() > before + 200; }));
  match.stop_all();
  const Reader log{match.folder / "match.db"};
  const auto first = number_of(log, "SELECT min(t_ns) FROM odometry"),
             last = number_of(log, "SELECT max(t_ns) FROM odometry");
  const auto received =
      std::ranges::count_if(witness.odometry_t_ns, [&](auto t_ns) { return first <= t_ns && t_ns <= last; });
  const auto told = number_of(
      log,
      "SELECT (SELECT count(*) FROM odometry) + sum(max(lost, gaps) + overflow + nan_refused + rejected) FROM losses "
      "WHERE stream = 'odometry' AND robot_id = 0");
  EXPECT_LT(number_of(log, "SELECT count(*) FROM odometry"), received - 200)
      << "nothing was lost: the test sees nothing";
  EXPECT_NEAR(static_cast<double>(told), static_cast<double>(received), 3.0)
      << fmt::format("{}", fmt::join(losses_of(log), "\n"));
}

TEST(Silence, ARecorderThatIsKilledAndStartedAgainGoesOnAndCountsTheKicksInBetween) {
  Match match;
  Witness& witness = match.witness;
  ASSERT_TRUE(witness.hears_kicks(2)) << match.node("kicker_driver").errors();
  match.node("recorder").signal(SIGKILL);
  match.node("recorder").wait();
  ASSERT_TRUE(witness.hears_kicks(2));
  match.start("recorder");
  ASSERT_TRUE(wait_for_change(match.folder.path(), match.node("recorder").watch(),
                              [&] { return match.folder.files(".db").size() == 2; }));
  ASSERT_TRUE(witness.hears_kicks(2));
  match.stop_all();

  std::string second;
  for (const std::string& name : match.folder.files(".db"))
    if (name != "match.db") second = name;
  EXPECT_THAT(second, testing::MatchesRegex("match-r1-[0-9]+T[0-9]+Z\\.db"));
  EXPECT_THAT(match.node("recorder").errors(), HasSubstr(second));
  const Reader one{match.folder / "match.db"};
  const Reader two{match.folder / second};
  EXPECT_EQ(two.sessions().at(0).continues_uuid, one.sessions().at(0).uuid);
  EXPECT_EQ(rows_of(two, "SELECT * FROM continued").size(), 1u);

  // Each kick that the coil was told of stands in a log or is counted.
  const std::set<std::int64_t> recorded = accepted_in({&one, &two});
  std::size_t unrecorded = 0;
  for (const std::int64_t kick : witness.fires) unrecorded += recorded.contains(kick) ? 0 : 1;
  EXPECT_GE(unrecorded, 1u) << "no kick fell between the logs";
  int code = 0;
  const auto json = match.report(second, code);
  EXPECT_EQ(code, 3);
  ASSERT_THAT(json.at("data_quality").at("unrecorded_orders"), SizeIs(1));
  const auto& gap = json.at("data_quality").at("unrecorded_orders")[0];
  EXPECT_EQ(gap.at("kicks_before"), unrecorded);
  EXPECT_EQ(gap.at("kicks_within"), 0);
  EXPECT_TRUE(gap.at("continues"));
  Program text{"trivela", {"report", second}, match.folder.path()};
  text.wait();
  EXPECT_THAT(text.output(), HasSubstr("between the session that this one continues and this one its driver handled"));
  EXPECT_THAT(text.output(), HasSubstr("it continues session " + one.sessions().at(0).uuid));
}

}  // namespace
}  // namespace trivela::e2e
