#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

#include "pages/lob/lob_page.hpp"
#include "pages/lob/replay_scene.hpp"
#include "pages/serve/page_server.hpp"
#include "tests/pages/recorded_lobs.hpp"
#include "tests/pages/stalled_viewer.hpp"
#include "tests/pages/viewer.hpp"

namespace trivela::pages {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const RecordedLobs& record() {
  static const RecordedLobs lobs({{15, 5.97}, {15, 6.05}, {20, 7.33}});
  return lobs;
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

class ReplayPage : public testing::Test {
 protected:
  ReplayPage() { command({{"playing", false}}); }
  ~ReplayPage() override { std::filesystem::remove(evaluator_verdicts()); }

  static std::filesystem::path evaluator_verdicts() { return record().path("lobs.db.verdicts.json"); }
  void command(const json& arguments) const { ASSERT_EQ(post(server_.port(), "player", arguments), 200); }
  json state() const { return json::parse(get(server_.port(), "/api/state")); }
  void to_the_end() const { command({{"position", 1'000'000}}); }

  Broadcast broadcast_{lob_channels()};
  ReplayScene scene_{record().path(), {}, {.powers = {15, 20}, .trials = 2}, broadcast_};
  PageServer server_{lob_page(scene_), broadcast_, {}};
};

TEST_F(ReplayPage, ServesItselfWithoutOtherSites) {
  const std::string html = get(server_.port(), "/");
  EXPECT_THAT(html, HasSubstr("<canvas id=\"scan\">"));
  for (const char* const file : {"/page.js", "/page.css"}) EXPECT_THAT(html, HasSubstr(file));
  for (const char* const file : {"/", "/page.js", "/page.css"}) {
    EXPECT_THAT(get(server_.port(), file), testing::Not(HasSubstr("http:/"))) << file;
    EXPECT_THAT(get(server_.port(), file), testing::Not(HasSubstr("https:/"))) << file;
  }
}

TEST_F(ReplayPage, TheStateHoldsLobsTablePlanAndSetup) {
  to_the_end();
  const json all = state();
  ASSERT_EQ(all["lobs"].size(), 3u);
  EXPECT_EQ(all["lobs"][0]["power"], 15.0);
  EXPECT_EQ(all["lobs"][0]["accepted"], true) << all["lobs"][0]["why"];
  ASSERT_EQ(all["table"].size(), 2u);
  EXPECT_EQ(all["table"][0]["trials"], 2);
  EXPECT_EQ(all["plan"]["powers"][1], json({{"power", 20.0}, {"done", 1}}));
  EXPECT_EQ(all["setup"]["synthetic"], true);
  EXPECT_EQ(all["setup"]["beams"], 1081);
  EXPECT_EQ(all["status"]["scans"], record().scans().size());
  EXPECT_THAT(get(server_.port(), "/api/table.csv"), HasSubstr("power,height_m,distance_m\n15,"));
}

TEST_F(ReplayPage, LobsAppearWhenTheReplayReachesTheirEndAndGoWhenItPlaysBack) {
  to_the_end();
  const auto end = state()["lobs"][0]["end"].get<std::int64_t>();
  command({{"position", end - 1}});
  EXPECT_EQ(state()["lobs"].size(), 0u);
  command({{"step", 1}});
  EXPECT_EQ(state()["lobs"].size(), 1u);
  command({{"step", -1}});
  EXPECT_EQ(state()["lobs"].size(), 0u);
}

TEST_F(ReplayPage, SteppingBackwardsShowsTheSameAsForwards) {
  std::vector<std::string> forwards;
  command({{"position", 100}});
  for (int i = 0; i < 40; ++i) {
    forwards.push_back(get(server_.port(), "/api/frame?i=" + std::to_string(state()["status"]["position"].get<int>())));
    command({{"step", 1}});
  }
  for (int i = 39; i >= 0; --i) {
    command({{"step", -1}});
    EXPECT_EQ(state()["status"]["position"], 100 + i);
    EXPECT_EQ(get(server_.port(), "/api/frame?i=" + std::to_string(100 + i)), forwards[static_cast<std::size_t>(i)]);
  }
}

TEST_F(ReplayPage, RejectingALobChangesTheTableAndIsKeptBesideTheRecord) {
  const std::string before = bytes_of(record().path());
  to_the_end();
  ASSERT_EQ(post(server_.port(), "verdict", {{"lob", 1}, {"accepted", false}, {"why", "touched a foot"}}), 200);
  EXPECT_EQ(state()["table"][0]["trials"], 1);
  EXPECT_EQ(state()["lobs"][1]["why"], "rejected by the operator: touched a foot");
  EXPECT_EQ(bytes_of(record().path()), before) << "a finished record is never changed";

  Broadcast broadcast{lob_channels()};
  ReplayScene again(record().path(), {}, {}, broadcast);
  again.command("player", {{"position", 1'000'000}});
  EXPECT_EQ(again.state()["table"][0]["trials"], 1);
  ASSERT_EQ(post(server_.port(), "verdict", {{"lob", 1}, {"accepted", true}}), 200);
  EXPECT_EQ(state()["table"][0]["trials"], 2);
}

TEST_F(ReplayPage, CommandsOfOtherSitesAreRefused) {
  const json pause{{"playing", false}};
  const std::string own = "127.0.0.1:" + std::to_string(server_.port());
  EXPECT_EQ(post(server_.port(), "player", pause, {{"Origin", "http://evil.example"}}), 403);
  EXPECT_EQ(post(server_.port(), "player", pause, {{"Origin", "null"}}), 403);
  EXPECT_EQ(post(server_.port(), "player", pause, {{"Host", "evil.example"}}), 403) << "a name that was rebound";
  EXPECT_EQ(post(server_.port(), "player", pause, {}, "text/plain"), 415) << "what a form can send";
  EXPECT_EQ(post(server_.port(), "player", pause, {{"Origin", "http://" + own}}), 200);
}

TEST_F(ReplayPage, CommandsThatMakeNoSenseAreAnsweredWithASentence) {
  const auto refused = [&](const std::string& name, const json& arguments, int status, const std::string& sentence) {
    std::string body;
    EXPECT_EQ(post(server_.port(), name, arguments, {}, "application/json", &body), status) << sentence;
    EXPECT_THAT(body, HasSubstr(sentence));
  };
  to_the_end();
  refused("player", {{"speed", 0.0}}, 400, "a speed of 0");
  refused("player", {{"speed", "fast"}}, 400, "makes no sense");
  refused("verdict", {{"lob", 99}, {"accepted", false}}, 404, "there is no lob 99");
  refused("verdict", {{"lob", 0}}, 400, "makes no sense");
  refused("set-point", {{"power", 20}}, 409, "a finished record is never changed");
  std::string body;
  EXPECT_EQ(post(server_.port(), "frames", {}, {}, "application/json", &body), 409);
  EXPECT_THAT(get(server_.port(), "/api/frame?i=999999"), HasSubstr("there is no scan 999999"));
  EXPECT_THAT(get(server_.port(), "/api/frame?i=x"), HasSubstr("i must be a number"));
}

TEST_F(ReplayPage, APortThatIsTakenIsNamed) {
  try {
    const PageServer second(lob_page(scene_), broadcast_, {.host = "127.0.0.1", .port = server_.port()});
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(error.what(),
              "cannot listen on 127.0.0.1:" + std::to_string(server_.port()) + ": Address already in use");
  }
}

TEST_F(ReplayPage, ThirtyViewersDoNotSlowTheFirst) {
  constexpr std::size_t kScans = 100;
  Viewer first(server_.port());
  std::vector<std::unique_ptr<Viewer>> others;
  for (int i = 0; i < 30; ++i) others.push_back(std::make_unique<Viewer>(server_.port()));
  for (auto& other : others) ASSERT_TRUE(other->wait([&] { return !other->frames.empty(); }));
  ASSERT_TRUE(first.wait([&] { return !first.frames.empty(); }));
  command({{"position", 0}, {"speed", 1.0}, {"playing", true}});
  ASSERT_TRUE(first.wait([&] { return first.frames.back() >= kScans; }));
  std::size_t seen = 0;
  first.wait([&] {
    seen = static_cast<std::size_t>(std::ranges::count_if(first.frames, [&](std::size_t i) { return i <= kScans; }));
    return true;
  });
  EXPECT_GE(seen, kScans * 9 / 10) << "of the scans played";
  for (auto& other : others) ASSERT_TRUE(other->wait([&] { return other->frames.back() >= kScans; }));
}

TEST(ReplayPageServer, StalledViewersHoldUpNeitherOthersNorTheEnd) {
  Broadcast broadcast{lob_channels()};
  ReplayScene scene(record().path(), {}, {}, broadcast);
  auto server = std::make_unique<PageServer>(lob_page(scene), broadcast, ListenAddress{});
  std::vector<std::unique_ptr<StalledViewer>> stalled;
  for (int i = 0; i < 5; ++i) stalled.push_back(std::make_unique<StalledViewer>(server->port()));
  for (const auto& viewer : stalled) ASSERT_TRUE(viewer->connected());
  Viewer viewer(server->port());
  ASSERT_EQ(post(server->port(), "player", {{"position", 0}, {"speed", 2.0}, {"playing", true}}), 200);
  ASSERT_TRUE(viewer.wait([&] { return !viewer.frames.empty() && viewer.frames.back() >= 150; }));
  const auto before = std::chrono::steady_clock::now();
  server.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds{1});
  EXPECT_TRUE(viewer.wait([&] { return viewer.ended; }));
}

TEST(ReplayPageServer, ARecordWithoutScansIsNamed) {
  const RecordedLobs empty({});
  log::ScanWriter(empty.path("none.db"), empty.session()).finalise();
  Broadcast broadcast{lob_channels()};
  try {
    const ReplayScene scene(empty.path("none.db"), {}, {}, broadcast);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(error.what(), empty.path("none.db").string() + " holds no scans");
  }
}

}  // namespace
}  // namespace trivela::pages
