// The live page on a real bus: five robots at 50 Hz, thirty viewers, one who reads nothing.
#include "pages/monitor/match_feed.hpp"

#include <gmock/gmock.h>

#include <array>
#include <memory>

#include "bus/executor.hpp"
#include "bus/writer.hpp"
#include "pages/monitor/monitor_page.hpp"
#include "pages/serve/page_server.hpp"
#include "tests/bus/test_domain.hpp"
#include "tests/pages/kicks_of_a_match.hpp"
#include "tests/pages/stalled_viewer.hpp"
#include "tests/pages/viewer.hpp"

namespace trivela::pages {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::uint8_t kRobots = 5;
constexpr std::int64_t kKicks = 12;  // of each robot

/// A process with five robots' nodes, as far as the page knows them: each writes what it believes, decides and has, at 50
/// Hz; a kick every tenth cycle, whose words come twice and out of order.
class Team {
 public:
  explicit Team(const bus::DomainConfig& domain)
      : participant_(domain),
        node_(participant_, "team"),
        world_(node_.writer<msg::WorldState>()),
        kicker_(node_.writer<msg::KickerStatus>()),
        referee_(node_.writer<msg::Referee>()),
        decision_(node_.writer<msg::KickDecision>()),
        receipt_(node_.writer<msg::KickReceipt>()),
        outcome_(node_.writer<msg::KickOutcome>()) {
    node_.every(milliseconds(20), "cycle", [this] { cycle(); },
                bus::writes<msg::WorldState, msg::KickerStatus, msg::Referee, msg::KickDecision, msg::KickReceipt,
                            msg::KickOutcome>());
    thread_ = std::thread([this] { bus::Executor{bus::Executor::kWaitset, stop_, {&node_}}.run(); });
  }
  ~Team() {
    stop_.request();
    thread_.join();
  }
  const bus::Participant& participant() const { return participant_; }

 private:
  void cycle() {
    ++seq_;
    for (std::uint8_t robot = 1; robot <= kRobots; ++robot) {
      world_.write(world(robot, seq_, true, robot == 1));
      kicker_.write(kicker(robot, seq_));
      referee_.write(referee(robot, seq_));
      const auto kick = static_cast<std::int64_t>(seq_ / 10);
      const bool kicks = seq_ % 10 == 0 && kick <= kKicks;
      decision_.write(decision(robot, kicks ? kick : 0, robot < 4 ? msg::POLICY_STOPPED : msg::POLICY_MOVING, seq_));
      for (int again = 0; kicks && again < 2; ++again) {
        const bool inside = kick % 3 != 0;
        outcome_.write(outcome(robot, kick, inside ? msg::OUTCOME_ON_TARGET : msg::OUTCOME_OVER, ++words_));
        receipt_.write(receipt(robot, kick, true, ++words_));
      }
    }
  }

  bus::Participant participant_;
  bus::Node node_;
  bus::Output<msg::WorldState> world_;
  bus::Output<msg::KickerStatus> kicker_;
  bus::Output<msg::Referee> referee_;
  bus::Output<msg::KickDecision> decision_;
  bus::Output<msg::KickReceipt> receipt_;
  bus::Output<msg::KickOutcome> outcome_;
  std::uint64_t seq_ = 0, words_ = 0;
  bus::Stop stop_;
  std::thread thread_;
};

/// The page of a domain.
struct Served {
  explicit Served(const bus::DomainConfig& domain) : feed(domain, false, scene(), broadcast) {}
  static SceneSettings scene() { return {.title = "five", .own_half_ball_offset_m = {}}; }

  Broadcast broadcast{match_channels()};
  MatchFeed feed;
  PageServer server{monitor_page(), broadcast, {}};
};

TEST(LivePageOfAMatch, ShowsFiveRobotsToThirtyViewersAndCountsEachKickOnce) {
  const bus::WirePair wire = bus::fresh_wire_pair();
  Served page(wire.b);
  const StalledViewer reads_nothing(page.server.port());
  ASSERT_TRUE(reads_nothing.connected());
  std::vector<std::unique_ptr<Viewer>> viewers;
  for (int i = 0; i < 30; ++i) viewers.push_back(std::make_unique<Viewer>(page.server.port()));
  for (const auto& viewer : viewers) ASSERT_TRUE(viewer->wait([&] { return viewer->events["match"] > 0; }));
  const Team team(wire.a);
  for (const auto& viewer : viewers) {
    ASSERT_TRUE(viewer->wait([&] {
      const auto& rows = viewer->newest["match"]["table"]["rows"];
      return viewer->newest["pitch"]["robots"].size() == kRobots && rows.size() == 2 && rows[0]["inside"] == 24 &&
             rows[1]["inside"] == 16;
    })) << viewer->newest["match"];
    viewer->wait([&] {
      const auto& rows = viewer->newest["match"]["table"]["rows"];
      EXPECT_EQ(rows[0]["policy"], "stopped");
      EXPECT_EQ(rows[0]["outside"], 12);
      EXPECT_EQ(rows[1]["outside"], 8);
      EXPECT_EQ(rows[1]["unknown"].get<int>() + rows[1]["under_way"].get<int>(), 0);
      return true;
    });
  }
  const int before = viewers.front()->events["pitch"];
  ASSERT_TRUE(viewers.front()->wait([&] { return viewers.front()->events["pitch"] > before + 25; }));
}

TEST(LivePageOfAMatch, HasNoWriterAndNoReaderThatAnybodyWaitsFor) {
  const bus::WirePair wire = bus::fresh_wire_pair();
  const bus::Participant outside(wire.a);
  bus::CensusTaker taker(outside);
  const Served page(wire.b);
  bus::Census census = taker.take();
  const auto end = std::chrono::steady_clock::now() + kPatience;
  const auto listens_to_all = [&] {
    std::size_t topics = 0;
    bus::for_each_message([&]<class T>() { topics += MatchScene::listens_to<T>() ? 1 : 0; });
    return census.readers.size() == topics;
  };
  while (!listens_to_all() && std::chrono::steady_clock::now() < end)
    if (taker.wait(seconds(1))) census = taker.take();
  ASSERT_TRUE(listens_to_all()) << census.readers.size();
  EXPECT_TRUE(census.writers.empty()) << census.writers.front().topic;
  for (const bus::End& reader : census.readers) {
    EXPECT_TRUE(reader.observer) << reader.topic;
    EXPECT_FALSE(reader.topic.starts_with("sim/")) << reader.topic;
  }
}

TEST(LivePageOfAMatch, IsToldThatADeviceIsEmulatedThoughThatWasSaidBeforeItCame) {
  const bus::WirePair wire = bus::fresh_wire_pair();
  const bus::Participant robot(wire.a);
  bus::Writer<msg::DeviceEmulated> writer(robot);
  msg::DeviceEmulated word{};
  word.robot_id = 1;
  word.part = msg::PART_REFEREE_BOX;
  word.seq = 1;
  writer.write(word);
  const Served page(wire.b);
  Viewer viewer(page.server.port());
  EXPECT_TRUE(viewer.wait([&] {
    const auto& match = viewer.newest["match"];
    return !match.is_null() && match["simulated"] == nlohmann::json::array({"an emulated referee box"});
  }));
  EXPECT_EQ(writer.readers(), 0u) << "it looks on";
}

TEST(LivePageOfAMatch, IsSimulatedWhereAWriterOfTruthIsThere) {
  const bus::WirePair wire = bus::fresh_wire_pair();
  const Served page(wire.b);
  Viewer viewer(page.server.port());
  ASSERT_TRUE(viewer.wait([&] { return viewer.events["match"] > 0; }));
  const bus::Participant world(wire.a);
  const bus::Writer<msg::PossessionTruth> truth(world);
  EXPECT_TRUE(viewer.wait([&] {
    const auto& match = viewer.newest["match"];
    return !match.is_null() && match["simulated"] == nlohmann::json::array({"a simulator"});
  }));
}

TEST(LivePageOfAMatch, GoesAtOnceWhateverItsViewersDo) {
  const bus::WirePair wire = bus::fresh_wire_pair();
  auto page = std::make_unique<Served>(wire.b);
  const StalledViewer reads_nothing(page->server.port());
  Viewer viewer(page->server.port());
  ASSERT_TRUE(viewer.wait([&] { return viewer.events["pitch"] > 3; }));
  page.reset();
  EXPECT_TRUE(viewer.wait([&] { return viewer.ended; }));
}

}  // namespace
}  // namespace trivela::pages
