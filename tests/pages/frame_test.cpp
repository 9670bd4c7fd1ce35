#include "pages/lob/lob_page.hpp"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

namespace trivela::pages {
namespace {

using kicking::lob::BallCentre;
using kicking::lob::ScanView;
using nlohmann::json;
using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::array<std::size_t, 3>> runs_of(const std::vector<std::uint8_t>& foreground,
                                                const std::vector<std::uint8_t>& ball) {
  ScanView view;
  view.foreground = foreground;
  view.ball = ball;
  std::vector<std::array<std::size_t, 3>> runs;
  for (const BeamRun& run : scene_of(view).runs)
    runs.push_back({run.first, run.last, static_cast<std::size_t>(run.kind)});
  return runs;
}

TEST(Frame, NeighbouringBeamsOfAKindAreOneRun) {
  using Run = std::array<std::size_t, 3>;
  EXPECT_THAT(runs_of({0, 0, 0}, {0, 0, 0}), IsEmpty());
  EXPECT_THAT(runs_of({1, 1, 0, 1}, {0, 0, 0, 0}), ElementsAre(Run{0, 1, 1}, Run{3, 3, 1}));
  EXPECT_THAT(runs_of({1, 1, 1, 1, 0}, {0, 1, 1, 0, 0}), ElementsAre(Run{0, 0, 1}, Run{1, 2, 2}, Run{3, 3, 1}));
  EXPECT_THAT(runs_of({1, 1}, {}), ElementsAre(Run{0, 1, 1})) << "before a ball was looked for";
}

TEST(Frame, SaysRangesInBase64AndTheRestInNumbers) {
  const std::vector<BallCentre> track{{.t_ns = 0, .x_m = 1.0, .z_m = 0.5}, {.t_ns = 1, .x_m = 1.25, .z_m = 0.75}};
  ScanView view;
  view.background_known = true;
  view.foreground = {0, 1, 1};
  view.ball = {0, 1, 0};
  view.centre = track.back();
  view.track = &track;
  // 258 = 0x0102; 19 is an error code; 70000 does not fit.
  const json frame = json::parse(frame_json(7, 1.5, std::vector<std::uint32_t>{258, 19, 70000}, 100.0, scene_of(view)));
  EXPECT_EQ(frame["i"], 7);
  EXPECT_EQ(frame["t_s"], 1.5);
  EXPECT_EQ(frame["ready"], true);
  EXPECT_EQ(frame["ranges"], "AgEAAP//") << "02 01 00 00 ff ff";
  EXPECT_EQ(frame["runs"], json::parse("[[1,1,2],[2,2,1]]"));
  EXPECT_EQ(frame["centre"], json::parse("[1.25,0.75]"));
  EXPECT_EQ(frame["track"], json::parse("[[1.0,0.5],[1.25,0.75]]"));
}

TEST(Frame, PadsItsBase64) {
  const auto ranges = [](const std::vector<std::uint32_t>& range_mm) {
    return json::parse(frame_json(0, 0.0, range_mm, 30.0, {}))["ranges"].get<std::string>();
  };
  EXPECT_EQ(ranges({}), "");
  EXPECT_EQ(ranges({258}), "AgE=");
  EXPECT_EQ(ranges({258, 258}), "AgECAQ==");
  EXPECT_EQ(ranges({30001}), "AAA=") << "farther than the scanner sees";
}

TEST(Frame, WithoutABallThereIsNoCentre) {
  const json frame = json::parse(frame_json(0, 0.0, std::vector<std::uint32_t>{100}, 30.0, {}));
  EXPECT_TRUE(frame["centre"].is_null());
  EXPECT_THAT(frame["track"], IsEmpty());
  EXPECT_THAT(frame["runs"], IsEmpty());
  EXPECT_EQ(frame["ready"], false);
}

}  // namespace
}  // namespace trivela::pages
