// The live page on a real bus: five robots at 50 Hz, thirty viewers, one who reads nothing.
#include "pages/monitor/match_feed.hpp"

#include <gmock/gmock.h>

#include <memory>

#include "bus/writer.hpp"
#include "pages/serve/page_server.hpp"
#include "tests/bus/test_domain.hpp"
#include "tests/pages/stalled_viewer.hpp"
#include "tests/pages/viewer.hpp"
#include "tests/pages/written_team.hpp"

namespace trivela::pages {
namespace {

/// The page of a domain.
struct Served {
  explicit Served(const bus::DomainConfig& domain) : feed(domain, false, scene(), broadcast) {}
  static SceneSettings scene() { return {.title = "five"}; }

  Broadcast broadcast{match_channels()};
  MatchFeed feed;
  PageServer server{monitor_page(), broadcast, {}};
};

constexpr std::int64_t kOutside = kKicks / 3;
constexpr std::int64_t kInside = kKicks - kOutside;

std::int64_t kicks_of(const nlohmann::json& rows) {
  std::int64_t kicks = 0;
  for (const auto& row : rows) kicks += row["inside"].get<std::int64_t>() + row["outside"].get<std::int64_t>();
  return kicks;
}

void expect_counts(const nlohmann::json& row, const char* policy, int robots) {
  EXPECT_EQ(row["policy"], policy);
  EXPECT_EQ(row["inside"], robots * kInside) << row;
  EXPECT_EQ(row["outside"], robots * kOutside) << row;
  EXPECT_EQ(row["unknown"], 0) << row;
  EXPECT_EQ(row["under_way"], 0) << row;
}

TEST(LivePageOfAMatch, ShowsFiveRobotsToThirtyViewersAndCountsEachKickOnce) {
  const bus::WirePair wire = bus::fresh_wire_pair();
  Served page(wire.b);
  const StalledViewer reads_nothing(page.server.port());
  ASSERT_TRUE(reads_nothing.connected());
  std::vector<std::unique_ptr<Viewer>> viewers;
  for (int i = 0; i < 30; ++i) viewers.push_back(std::make_unique<Viewer>(page.server.port()));
  for (const auto& viewer : viewers) ASSERT_TRUE(viewer->wait([&] { return viewer->events["match"] > 0; }));
  const WrittenTeam team(wire.a);
  for (const auto& viewer : viewers) {
    ASSERT_TRUE(viewer->wait([&] {
      const auto& rows = viewer->newest["match"]["table"]["rows"];
      return viewer->newest["pitch"]["robots"].size() == kRobots && rows.size() == 2 &&
             kicks_of(rows) == kRobots * kKicks;
    })) << viewer->newest_of("match");
  }
  int before = 0;
  viewers.front()->wait([&] { return (before = viewers.front()->events["pitch"]) >= 0; });
  ASSERT_TRUE(viewers.front()->wait([&] { return viewers.front()->events["pitch"] > before + 25; }));
  const auto rows = viewers.front()->newest_of("match")["table"]["rows"];
  expect_counts(rows[0], "stopped", 3);
  expect_counts(rows[1], "moving", 2);
}

TEST(LivePageOfAMatch, HasNoWriterAndNoReaderThatAnybodyWaitsFor) {
  const bus::WirePair wire = bus::fresh_wire_pair();
  const bus::Participant outside(wire.a);
  bus::CensusTaker taker(outside);
  const Served page(wire.b);
  bus::Census census = taker.take();
  const auto end = std::chrono::steady_clock::now() + kTimeout;
  const auto listens_to_all = [&] {
    std::size_t topics = 0;
    bus::for_each_message([&]<class T>() { topics += MatchScene::listens_to<T>() ? 1 : 0; });
    return census.readers.size() == topics;
  };
  while (!listens_to_all() && std::chrono::steady_clock::now() < end)
    if (taker.wait(std::chrono::seconds(1))) census = taker.take();
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

TEST(LivePageOfAMatch, ShowsAChangeOfAKickerThatWasSaidBeforeItCame) {
  const bus::WirePair wire = bus::fresh_wire_pair();
  const bus::Participant robot(wire.a);
  bus::Writer<msg::KickerDrift> writer(robot);
  msg::KickerDrift said{};
  said.robot_id = 3;
  said.seq = said.changes = 1;
  said.changed_kick_id = 61;
  said.factor = 0.95;
  said.factor_se = 0.01;
  writer.write(said);
  const Served page(wire.b);
  Viewer viewer(page.server.port());
  EXPECT_TRUE(viewer.wait([&] {
    return viewer.newest["match"].dump().find("robot 3: its kicker changed at kick 61: exit speed fell by 5.0 %") !=
           std::string::npos;
  }));
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
