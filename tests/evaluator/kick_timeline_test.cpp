// What a replay is made of, out of rows written by hand.
#include "evaluator/timeline/kick_timeline.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "evaluator/sessions/session_facts.hpp"
#include "kicking/geometry/angle.hpp"
#include "tests/evaluator/log_fixture.hpp"

namespace trivela::evaluator {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using Int = std::int64_t;

constexpr Int kMs = 1'000'000;
constexpr Int kKick = Int{5} << 48 | Int{2} << 40 | 7;  // the seventh order of robot 2
constexpr Int kDecided = 10'000 * kMs;

/// Writes the rows of a robot's streams.
class TimelineLog {
 public:
  TimelineLog(const std::filesystem::path& path, const log::Session& session, log::WriterOptions options)
      : writer_(path, session, std::move(options)) {}

  /// The robot drives along +x by 1 m/s, at x = 0 when the kick is decided, the ball 0.3 m before it.
  void world(Int t_ns, double elsewhere_m = 0.0) {
    const double x_m = 1e-9 * static_cast<double>(t_ns - kDecided) + elsewhere_m;
    writer_.push(
        writer_.table("world_states", {"robot_id", "seq", "t_ns", "half", "playing", "possession_id", "x_m", "y_m",
                                       "heading_rad", "vx_mps", "vy_mps", "omega_radps", "sd_position_m",
                                       "sd_heading_rad", "ball_known", "ball_x_m", "ball_y_m", "possession"}),
        {Int{2}, ++seq_, t_ns, Int{1}, Int{1}, Int{1}, x_m, 4.0, 0.0, 1.0, 0.0, 0.0, 0.1, 0.01, Int{1}, x_m, 4.3,
         Int{1}});
  }

  void flight(Int t_ns, bool seen, double y_m, double z_m) {
    writer_.push(writer_.table("flight_frames", {"robot_id", "seq", "t_ns", "t_exposure_ns", "ball_seen", "ball_x_m",
                                                 "ball_y_m", "ball_z_m"}),
                 {Int{2}, ++seq_, t_ns + kMs, t_ns, Int{seen}, 0.5, y_m, z_m});
  }

  void opponent(Int t_ns, double x_m, double y_m) {
    writer_.push(writer_.table("vision_frames", {"robot_id", "seq", "t_ns", "t_exposure_ns", "pose_seen", "ball_seen",
                                                 "opponent_seen", "opponent_x_m", "opponent_y_m", "keeper_seen"}),
                 {Int{2}, ++seq_, t_ns + kMs, t_ns, Int{0}, Int{0}, Int{1}, x_m, y_m, Int{0}});
  }

  /// From (0, 4), straight on, its S1 meeting the goal line 0.5 m right of (0, 9).
  void decision() {
    writer_.push(
        writer_.table("kick_decisions", {"robot_id",
                                         "seq",
                                         "t_ns",
                                         "kick_id",
                                         "half",
                                         "possession_id",
                                         "policy",
                                         "fire",
                                         "reason",
                                         "x_m",
                                         "y_m",
                                         "heading_rad",
                                         "vx_mps",
                                         "vy_mps",
                                         "omega_radps",
                                         "target_x_m",
                                         "target_y_m",
                                         "target_z_m",
                                         "distance_m",
                                         "alpha_rad",
                                         "beta_rad",
                                         "aligned",
                                         "left_m",
                                         "right_m",
                                         "charge",
                                         "shadow_count",
                                         "fire_after_s",
                                         "power",
                                         "assignment_probability",
                                         "predicted_x_cross_m",
                                         "predicted_z_cross_m",
                                         "predicted_t_flight_s",
                                         "offset_right_m"}),
        {Int{2}, ++seq_, kDecided, kKick, Int{1}, Int{1},         "moving", Int{1}, "fire", 0.0, 4.0, 0.0,    1.0, 0.0,
         0.0,    0.0,    9.0,      0.7,   4.7,    std::atan(0.1), 0.0,      Int{1}, 0.8,    1.2, 1.0, Int{0}, 0.0, 31.5,
         1.0,    0.45,   0.7,      0.6,   0.5});
  }

  void receipt(const std::string& refusal = "none") {
    writer_.push(writer_.table("kick_receipts",
                               {"robot_id", "seq", "t_ns", "kick_id", "accepted", "refusal", "order_t_ns", "fired_t_ns",
                                "release_t_ns", "power", "received_steady_ns", "fired_steady_ns"}),
                 {Int{2}, ++seq_, kDecided + 2 * kMs, kKick, Int{refusal == "none"}, refusal, kDecided,
                  kDecided + 4 * kMs, kDecided + 80 * kMs, 31.5, Int{0}, Int{0}});
  }

  void outcome(Int t_ns, const std::string& label) {
    writer_.push(writer_.table("kick_outcomes", {"robot_id", "seq", "t_ns", "kick_id", "outcome", "on_target",
                                                 "observations", "x_cross_m", "z_cross_m", "sd_cross_m"}),
                 {Int{2}, ++seq_, t_ns, kKick, label, Int{label == "on_target"}, Int{9}, 0.52, 0.61, 0.04});
  }

  void half_time(Int t_ns, double half_time_s) {
    std::vector<std::string> columns = referee_columns();
    columns.emplace_back("half_time_s");
    std::vector<log::Value> cells = referee_cells(2, ++seq_, t_ns, 1, true, 0);
    cells.emplace_back(half_time_s);
    writer_.push(writer_.table("referee", columns), cells);
  }

  /// A whole kick, each stream at 50 Hz, from 3 s before the decision to 2 s after it.
  void whole_kick() {
    for (Int t = -3000; t <= 2000; t += 20) {
      const Int t_ns = kDecided + t * kMs;
      world(t_ns);
      opponent(t_ns, 1.0, 2.0);
      flight(t_ns, t >= 100, 4.3 + 0.008 * static_cast<double>(t - 80), 0.5);
    }
    half_time(kDecided - 400 * kMs, 61.0);
    decision();
    receipt();
    outcome(kDecided + 700 * kMs, "on_target");
  }

  void skip(Int numbers) { seq_ += numbers; }
  void close() { writer_.finalise(); }

 private:
  log::Writer writer_;
  Int seq_ = 0;
};

class KickTimelines : public LogTest {
 protected:
  TimelineLog& log() {
    if (!log_) log_.emplace(path(), session(), options());
    return *log_;
  }
  std::vector<KickTimeline> timelines() {
    log().close();
    return kick_timelines(log::Reader(path()));
  }
  std::optional<TimelineLog> log_;
};

TEST_F(KickTimelines, HaveThePathFromBeforeTheDecisionToWhatSettledTheKick) {
  log().whole_kick();
  const auto told = timelines();
  ASSERT_THAT(told, SizeIs(1));
  const KickTimeline& timeline = told[0];
  EXPECT_EQ(timeline.number, 7);
  EXPECT_EQ(timeline.path.front().t_ns, -1500 * kMs);
  EXPECT_EQ(timeline.path.back().t_ns, 980 * kMs) << "0.3 s after what settled it, a sample in 40 ms";
  EXPECT_THAT(timeline.path, SizeIs(63));
  for (std::size_t i = 1; i < timeline.path.size(); ++i)
    EXPECT_EQ(timeline.path[i].t_ns - timeline.path[i - 1].t_ns, 40 * kMs) << i;
  EXPECT_NEAR(timeline.path.front().pose.x_m, -1.5, 1e-9);
  EXPECT_EQ(timeline.flight.front().t_ns, 100 * kMs) << "frames without the ball are none";
  EXPECT_NEAR(timeline.flight.front().place_m.y(), 4.46, 1e-9);
  ASSERT_FALSE(timeline.opponent.empty());
  EXPECT_NEAR(timeline.opponent.back().place_m.x() - timeline.path.back().pose.x_m, 1.0, 0.041) << "in F, not in R";
  EXPECT_NEAR(timeline.opponent.back().place_m.y(), 6.0, 1e-9);
  EXPECT_NEAR(*timeline.half_time_s, 61.4, 1e-9) << "by the referee's last word";
  EXPECT_NEAR(*timeline.released_after_s, 0.08, 1e-9);
  EXPECT_NEAR(*timeline.predicted->after_s, 0.68, 1e-9);
  EXPECT_EQ(timeline.observed->outcome, "on_target");
  EXPECT_NEAR(*timeline.observed->after_s, 0.7, 1e-9);
  EXPECT_FALSE(timeline.truth);
}

TEST_F(KickTimelines, DrawTheSegmentsThatTheDecisionHad) {
  log().whole_kick();
  const DecidedSegments segments = timelines().at(0).segments;
  EXPECT_TRUE(segments.aligned);
  EXPECT_NEAR(segments.s1_from_m.y(), 4.0, 1e-9) << "the robot's centre, since by it S1 has this offset";
  EXPECT_NEAR(segments.s1_to_m.x(), 0.5, 1e-9);
  EXPECT_NEAR(segments.s1_to_m.y(), 9.0, 1e-9);
  EXPECT_NEAR(segments.s2_left_m.x(), -0.8, 1e-9);
  EXPECT_NEAR(segments.s2_right_m.x(), 1.2, 1e-9);
}

TEST_F(KickTimelines, OfAKickAloneHaveNoPathsAndSayNothingOfThem) {
  log().decision();
  const auto told = timelines();
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_THAT(told[0].path, IsEmpty());
  EXPECT_FALSE(told[0].observed || told[0].released_after_s || told[0].half_time_s);
  const auto json = json_of(told[0]);
  for (const char* const stream : {"path", "ball", "flight", "opponent", "observed", "truth", "half_time_ms"})
    EXPECT_FALSE(json.contains(stream)) << stream;
  EXPECT_TRUE(json.contains("segments"));
}

TEST_F(KickTimelines, WithoutPosesHaveNoOpponentButTheBallInFlight) {
  log().decision();
  log().opponent(kDecided, 1.0, 2.0);
  log().flight(kDecided + 200 * kMs, true, 5.0, 0.6);
  const auto told = timelines();
  EXPECT_THAT(told.at(0).opponent, IsEmpty()) << "nobody knows where R was";
  EXPECT_THAT(told.at(0).flight, SizeIs(1));
}

TEST_F(KickTimelines, LeaveOutOrdersThatTheDriverRefused) {
  log().decision();
  log().receipt("charging");
  EXPECT_THAT(timelines(), IsEmpty());
}

TEST_F(KickTimelines, LeaveOutRowsOfOtherRobots) {
  log().whole_kick();
  log().close();
  const log::Reader reader(path());
  int rows = 0;
  reader.for_each_row_between("world_states", {"t_ns"}, {reader.sessions()[0].session_id, 3, 0, INT64_MAX / 2},
                              [&](auto) { ++rows; });
  EXPECT_EQ(rows, 0);
}

TEST_F(KickTimelines, OfASessionsFirstInstantBeginWithTheSession) {
  for (Int t = 0; t <= 400; t += 20) log().world(kDecided + t * kMs);
  log().decision();
  const auto told = timelines();
  EXPECT_EQ(told.at(0).path.front().t_ns, 0);
  EXPECT_EQ(told.at(0).path.back().t_ns, 380 * kMs) << "the first sample of the last step";
}

TEST_F(KickTimelines, EndWhereTheRobotIsSuddenlyElsewhere) {
  for (Int t = -1000; t <= 1000; t += 20) log().world(kDecided + t * kMs, t < -500 || t > 600 ? 3.0 : 0.0);
  log().decision();
  const auto told = timelines();
  EXPECT_EQ(told.at(0).path.front().t_ns, -500 * kMs);
  EXPECT_GE(told.at(0).path.back().t_ns, 560 * kMs);
  EXPECT_LE(told.at(0).path.back().t_ns, 600 * kMs);
  EXPECT_EQ(told.at(0).ball.front().t_ns, -500 * kMs);
}

TEST_F(KickTimelines, AreTheSameBytesForTheSameLog) {
  log().whole_kick();
  log().close();
  const auto text = [&] { return json_of(kick_timelines(log::Reader(path())).at(0)).dump(); };
  EXPECT_EQ(text(), text());
  EXPECT_THAT(text(), HasSubstr(R"("kick":"2:7","kick_id":")" + std::to_string(kKick) + '"'));
  EXPECT_THAT(text(), HasSubstr(R"("s1_cm":[0,400,50,900])"));
  EXPECT_THAT(text(), HasSubstr(R"("observed":{"outcome":"on_target","x_cm":52,"z_cm":61,"sd_cm":4,"t_ms":700})"));
  EXPECT_LT(text().size(), 6000u) << "200 of them stay below 1.2 MB";
}

TEST_F(KickTimelines, FindRowsWhereSequenceNumbersAreMissing) {
  for (Int t = -3000; t <= 3000; t += 20) {
    log().world(kDecided + t * kMs);
    if (t % 300 == 0) log().skip(1000);
  }
  log().decision();
  const auto told = timelines();
  EXPECT_EQ(told.at(0).path.front().t_ns, -1500 * kMs);
  EXPECT_EQ(told.at(0).path.back().t_ns, 1980 * kMs) << "2 s, where nothing settled it";
}

TEST(LoggedPitch, IsReadOutOfTheSettingsAndOfNothingElse) {
  const LoggedPitch pitch = pitch_of(
      "### settings\n[goal]\ny_m = 11.0\nhalf_width_m = 1.2\n\n[field]\nside_line_x_m = 7.0\n[other]\ny_m = 3.0\n"
      "\n### scenario\n[goal]\ny_m = 5.0\n");
  EXPECT_EQ(pitch.goal.y_m, 11.0);
  EXPECT_EQ(pitch.goal.half_width_m, 1.2);
  EXPECT_EQ(pitch.side_line_x_m, 7.0);
  EXPECT_EQ(pitch.goal.height_m, 1.0) << "by default";
}

TEST(Replay, IsAScriptThatReadsNoTextAsHtmlAndAsksNobody) {
  for (const char* const word :
       {"innerHTML", "outerHTML", "insertAdjacentHTML", "document.write", ".style", "eval(", "fetch("}) {
    EXPECT_THAT(std::string(replay_script()), Not(HasSubstr(word)));
  }
  EXPECT_THAT(std::string(replay_style()), Not(HasSubstr("url(")));
  EXPECT_THAT(std::string(replay_style()), HasSubstr("prefers-color-scheme: dark"));
}

}  // namespace
}  // namespace trivela::evaluator
