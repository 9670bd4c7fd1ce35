#include <gmock/gmock.h>

#include <atomic>

#include "hal/open.hpp"
#include "pages/lob/live_scene.hpp"
#include "pages/lob/lob_page.hpp"
#include "pages/serve/page_server.hpp"
#include "tests/hal/faulty_scanner.hpp"
#include "tests/pages/recorded_lobs.hpp"
#include "tests/pages/viewer.hpp"

namespace trivela::pages {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// A page on an emulated scanner, through the real client: the scans of a synthetic record in real time.
class LivePage : public testing::Test {
 protected:
  explicit LivePage(CalibrationPlan plan = {.powers = {15, 20}, .trials = 2}) : plan_(std::move(plan)) {}

  hal::scip::EmulatorConfig config() const {
    hal::scip::EmulatorConfig config;
    config.port = hal::scip::EmulatedPort::kTcp;
    config.geometry = record_.session().geometry;
    return config;
  }

  std::optional<kicking::lob::Scan> next_scan() {
    if (next_ == record_.scans().size()) return std::nullopt;
    return record_.scans()[next_++];
  }

  LiveOptions options() const {
    LiveOptions options;
    options.device = emulator_.address();
    options.record = record_.path("live.db");
    options.mount = record_.session().mount;
    options.plan = plan_;
    return options;
  }

  json state() const { return json::parse(get(server_.port(), "/api/state")); }

  CalibrationPlan plan_;
  RecordedLobs record_{{{15, 5.97}, {15, 6.05}, {20, 7.33}}};
  std::atomic<std::size_t> next_ = 0;  // also of the emulator's thread
  tests::FaultyEmulator emulator_{config(), [this] { return next_scan(); }};
  Broadcast broadcast_{lob_channels()};
  LiveScene scene_{hal::open_range_finder(emulator_.address()), options(), broadcast_};
  PageServer server_{lob_page(scene_), broadcast_, {}};
  Viewer viewer_{server_.port()};
};

TEST_F(LivePage, FollowsThePlanAndRecordsAllThatItShows) {
  ASSERT_TRUE(viewer_.wait([&] { return !viewer_.lobs.is_null() && viewer_.lobs["lobs"].size() == 3; }));
  json all = state();
  for (const json& lob : all["lobs"]) EXPECT_EQ(lob["accepted"], true) << lob["why"];
  EXPECT_EQ(all["plan"]["powers"], json::parse(R"([{"power":15.0,"done":2},{"power":20.0,"done":1}])"));
  EXPECT_EQ(all["status"]["power"], 20.0) << "two kicks with 15 are done";
  EXPECT_EQ(all["setup"]["mode"], "live");
  EXPECT_EQ(all["setup"]["synthetic"], true) << "an emulator says so";

  EXPECT_EQ(post(server_.port(), "verdict", {{"lob", 0}, {"accepted", false}, {"why", "a foot"}}), 200);
  all = state();
  EXPECT_EQ(all["table"][0]["trials"], 1);
  EXPECT_EQ(all["plan"]["powers"][0]["done"], 1);
  EXPECT_EQ(post(server_.port(), "set-point", {{"power", 17.5}}), 200);
  EXPECT_EQ(state()["status"]["power"], 17.5);
  scene_.finish();

  const log::ScanReader recorded(record_.path("live.db"));
  ASSERT_GT(recorded.size(), all["lobs"][2]["end"].get<std::size_t>());
  EXPECT_EQ(recorded.scan(7).range_mm, record_.scans()[7].range_mm);
  std::vector<double> powers;
  for (const auto& tested : recorded.set_points()) powers.push_back(tested.power.value_or(0.0));
  EXPECT_THAT(powers, testing::ElementsAre(15.0, 20.0, 17.5));
  const auto lobs = calibration::lobs_of_scans(recorded);
  ASSERT_EQ(lobs.size(), 3u);
  EXPECT_EQ(lobs[0].refusal, kicking::lob::Refusal::kOperator);
  EXPECT_EQ(lobs[0].why, "rejected by the operator: a foot");
  EXPECT_EQ(lobs[1].power, 15.0);
  EXPECT_EQ(lobs[2].power, 20.0);
}

/// A plan that is done before the last of the three lobs.
class LivePageAtThePlansEnd : public LivePage {
 protected:
  LivePageAtThePlansEnd() : LivePage({.powers = {15}, .trials = 2}) {}
};

TEST_F(LivePageAtThePlansEnd, WhatIsKickedAfterwardsIsNoTrialOfTheLastPower) {
  ASSERT_TRUE(viewer_.wait([&] { return !viewer_.lobs.is_null() && viewer_.lobs["lobs"].size() == 3; }));
  json all = state();
  EXPECT_EQ(all["status"]["power"], nullptr);
  EXPECT_EQ(all["lobs"][2]["power"], nullptr);
  EXPECT_EQ(all["lobs"][2]["accepted"], true) << "it was a lob";
  ASSERT_EQ(all["table"].size(), 1u);
  EXPECT_EQ(all["table"][0]["trials"], 2) << "of another power, it would be 1.3 m/s off";
  EXPECT_EQ(post(server_.port(), "verdict", {{"lob", 0}, {"accepted", false}}), 200);
  EXPECT_EQ(state()["status"]["power"], 15.0) << "the plan lacks a kick again";
  scene_.finish();

  const auto lobs = calibration::lobs_of_scans(log::ScanReader(record_.path("live.db")));
  ASSERT_EQ(lobs.size(), 3u);
  EXPECT_EQ(lobs[1].power, 15.0);
  EXPECT_EQ(lobs[2].power, std::nullopt) << "the record says so, too";
}

TEST_F(LivePage, LooksBackOverTheRecordWhileItGoesOn) {
  ASSERT_TRUE(viewer_.wait([&] { return !viewer_.frames.empty() && viewer_.frames.back() >= 50; }));
  const json early = json::parse(get(server_.port(), "/api/frame?i=3"));
  EXPECT_EQ(early["i"], 3);
  EXPECT_EQ(early["ready"], false) << "the background was not known";
  const std::size_t newest = state()["status"]["scans"].get<std::size_t>() - 1;
  EXPECT_EQ(json::parse(get(server_.port(), "/api/frame?i=" + std::to_string(newest)))["i"], newest);
  EXPECT_THAT(get(server_.port(), "/api/frame?i=999999"), HasSubstr("there is no scan 999999"));
}

TEST_F(LivePage, ShowsAPulledCableAndRecovers) {
  ASSERT_TRUE(viewer_.wait([&] { return !viewer_.status.is_null() && viewer_.status["link"]["up"] == true; }));
  emulator_.line().pull();
  ASSERT_TRUE(viewer_.wait([&] { return viewer_.status["link"]["up"] == false; }));
  emulator_.line().plug();
  next_ = 0;
  ASSERT_TRUE(viewer_.wait([&] { return viewer_.status["link"]["up"] == true; }));
  EXPECT_GE(state()["status"]["link"]["reconnects"], 1);
}

TEST_F(LivePage, CountsDamageOnTheLineAndGoesOn) {
  ASSERT_TRUE(viewer_.wait([&] { return !viewer_.status.is_null() && viewer_.status["link"]["up"] == true; }));
  emulator_.set(&tests::FaultyScanner::sums_to_corrupt, 3);
  ASSERT_TRUE(viewer_.wait([&] { return viewer_.status["link"]["wrong_sums"] == 3; }));
  emulator_.set(&tests::FaultyScanner::scans_to_skip, 2);
  ASSERT_TRUE(viewer_.wait([&] { return viewer_.status["link"]["lost_scans"] == 5; }));
  const std::size_t frames = state()["status"]["scans"].get<std::size_t>();
  ASSERT_TRUE(viewer_.wait([&] { return viewer_.frames.back() > frames; })) << "it goes on";
}

TEST_F(LivePage, RefusesWhatALiveScannerCannotDo) {
  std::string body;
  EXPECT_EQ(post(server_.port(), "player", {{"playing", true}}, {}, "application/json", &body), 404);
  EXPECT_THAT(body, HasSubstr("no command 'player'"));
  for (const double power : {0.0, -5.0}) EXPECT_EQ(post(server_.port(), "set-point", {{"power", power}}), 400);
  EXPECT_EQ(post(server_.port(), "verdict", {{"lob", 7}, {"accepted", true}}), 404);
}

TEST(LivePageWithoutScanner, SaysSoAndMakesNoRecord) {
  const RecordedLobs folder({});
  Broadcast broadcast{lob_channels()};
  LiveOptions options;
  options.device = folder.path("no_such_device").string();
  options.record = folder.path("live.db");
  LiveScene scene(hal::open_range_finder(options.device), options, broadcast);
  const PageServer server(lob_page(scene), broadcast, {});
  Viewer viewer(server.port());
  ASSERT_TRUE(viewer.wait([&] {
    return !viewer.status.is_null() &&
           viewer.status["link"]["text"].get<std::string>().find("no_such_device") != std::string::npos;
  }));
  EXPECT_EQ(viewer.status["link"]["up"], false);
  scene.finish();
  EXPECT_FALSE(std::filesystem::exists(options.record));
}

TEST_F(LivePage, ARecordThatCannotBeMadeIsAnError) {
  Broadcast broadcast{lob_channels()};
  LiveOptions options;
  hal::scip::EmulatorConfig other;
  other.port = hal::scip::EmulatedPort::kTcp;
  const hal::scip::Emulator emulator(other, [&] { return record_.scans()[0]; });
  options.device = emulator.address();
  options.record = record_.path("no/folder.db");
  LiveScene scene(hal::open_range_finder(options.device), options, broadcast);
  const auto deadline = std::chrono::steady_clock::now() + kTimeout;
  try {
    while (std::chrono::steady_clock::now() < deadline) scene.check();
    FAIL() << "no error came";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("cannot create the scan record"));
  }
}

}  // namespace
}  // namespace trivela::pages
