#include "evaluator/timeline/kick_picture.hpp"

#include <gmock/gmock.h>

#include <fmt/format.h>

#include <cmath>
#include <regex>
#include <vector>

namespace trivela::evaluator {
namespace {

using testing::HasSubstr;
using testing::Not;

struct Pixel {
  double x = 0.0, y = 0.0;
};

/// Points of each polyline of this class.
std::vector<std::vector<Pixel>> lines(const std::string& svg, const std::string& kind) {
  std::vector<std::vector<Pixel>> found;
  const std::regex line("<polyline class=\"" + kind + "\" points=\"([^\"]*)\""), point("(-?[\\d.]+),(-?[\\d.]+)");
  for (std::sregex_iterator it(svg.begin(), svg.end(), line), end; it != end; ++it) {
    const std::string points = (*it)[1];
    auto& pixels = found.emplace_back();
    for (std::sregex_iterator at(points.begin(), points.end(), point); at != end; ++at)
      pixels.push_back({std::stod((*at)[1]), std::stod((*at)[2])});
  }
  return found;
}

std::vector<Pixel> circles(const std::string& svg, const std::string& kind) {
  std::vector<Pixel> found;
  const std::regex circle("<circle class=\"" + kind + "\" cx=\"(-?[\\d.]+)\" cy=\"(-?[\\d.]+)\"");
  for (std::sregex_iterator it(svg.begin(), svg.end(), circle), end; it != end; ++it)
    found.push_back({std::stod((*it)[1]), std::stod((*it)[2])});
  return found;
}

/// The drawn goal says where metres of the field are.
struct DrawnScale {
  explicit DrawnScale(const std::string& svg, double half_width_m = 1.0) {
    const std::vector<Pixel> goal = lines(svg, "axis goal").at(0);
    middle = {0.5 * (goal.at(0).x + goal.at(3).x), goal.at(0).y};
    px_per_m = (goal.at(3).x - goal.at(0).x) / (2.0 * half_width_m);
  }
  Pixel middle;
  double px_per_m = 0.0;
};

KickPicture kick(kicking::Pose robot, kicking::Twist twist) {
  return {.robot = robot,
          .twist = twist,
          .kick = {.v_kick_mps = 8.2443, .exit_angle = kicking::radians(36.78), .delay_s = 0.08}};
}

TEST(KickPicture, TheCrossingLiesWhereThePredictorSays) {
  for (const auto& picture : {kick({-1.6, 3.0, 0.0}, {2.0, 0.0, 0.0}), kick({2.0, 4.0, 0.3}, {-1.0, 1.5, 1.0}),
                              kick({4.0, -6.0, 0.9}, {0.0, -1.0, -2.0}), kick({0.0, 8.5, 0.0}, {0.5, 0.0, 0.0})}) {
    const std::string svg = to_svg(picture);
    const DrawnScale scale(svg);
    const auto crossing =
        kicking::predict_crossing(picture.robot, picture.twist, picture.kick, 9.0, picture.ball.radius_m);
    ASSERT_TRUE(crossing);
    const std::vector<Pixel> marks = circles(svg, "crossing c1");
    ASSERT_EQ(marks.size(), 3u) << "from above, in the legend, from the side";
    EXPECT_NEAR(marks[0].x, scale.middle.x + scale.px_per_m * crossing->x_m, 1.0);
    EXPECT_NEAR(marks[0].y, scale.middle.y, 1.0);
    EXPECT_THAT(svg, HasSubstr(fmt::format("x = {:.2f} m", crossing->x_m)));
    const std::vector<Pixel> ball = circles(svg, "ball");
    EXPECT_NEAR(ball.at(0).y, scale.middle.y + scale.px_per_m * (9.0 - crossing->release_m.y()), 1.0);
    EXPECT_NEAR(ball[0].x, scale.middle.x + scale.px_per_m * crossing->release_m.x(), 1.0);
  }
}

TEST(KickPicture, TheBallsVelocityIsTheKickersAndTheRobotsTogether) {
  const std::string svg = to_svg(kick({-1.6, 3.0, 0.2}, {2.0, 0.7, 0.5}));
  const auto kicker = lines(svg, "c0 arrow").at(0), own = lines(svg, "c1 arrow").at(0),
             sum = lines(svg, "c2 arrow").at(0);
  EXPECT_NEAR(kicker.at(0).x, sum.at(0).x, 0.11);
  EXPECT_NEAR(kicker.at(1).x, own.at(0).x, 0.11);
  EXPECT_NEAR(own.at(1).x, sum.at(1).x, 0.11);
  EXPECT_NEAR(own.at(1).y, sum.at(1).y, 0.11);
  const auto way = lines(svg, "c6").at(1);  // behind the robot's heading
  EXPECT_NEAR((way.at(1).x - way.at(0).x) * (sum[1].y - sum[0].y), (way[1].y - way[0].y) * (sum[1].x - sum[0].x), 60.0)
      << "the ball goes along the sum";
}

TEST(KickPicture, FromTheSideTheBallCrossesAtItsHeightUnderTheBar) {
  const KickPicture picture = kick({0.0, 3.0, 0.0}, {0.0, 0.0, 0.0});
  const std::string svg = to_svg(picture);
  const auto crossing = kicking::predict_crossing(picture.robot, picture.twist, picture.kick, 9.0, 0.11);
  const std::vector<Pixel> balls = circles(svg, "ball");  // from above; from the side at the launch, on the line
  const double px_per_m = (balls.at(2).x - balls.at(1).x) / (9.0 - crossing->release_m.y());
  EXPECT_NEAR(balls[1].y - balls[2].y, px_per_m * (crossing->z_m - 0.11), 1.0);
  EXPECT_THAT(svg, HasSubstr(fmt::format("z = {:.2f} m", crossing->z_m)));
  EXPECT_THAT(lines(svg, "c6 d2"), testing::IsEmpty());
}

TEST(KickPicture, BehindItsFirstTouchOfTheFloorTheWayIsDotted) {
  const KickPicture picture = kick({0.0, -2.0, 0.0}, {0.0, 0.0, 0.0});
  const std::string svg = to_svg(picture);
  const DrawnScale scale(svg);
  const double v = picture.kick.v_kick_mps, range_m = v * v * std::sin(kicking::radians(2.0 * 36.78)) / 9.81;
  EXPECT_NEAR(circles(svg, "touch c6").at(0).y, scale.middle.y + scale.px_per_m * (11.0 - 0.27 - range_m), 1.0);
  EXPECT_EQ(lines(svg, "c6 d2").size(), 3u);
  EXPECT_THAT(svg, HasSubstr("on the floor"));
}

TEST(KickPicture, TheSegmentsAreThoseOfTheAlignment) {
  EXPECT_THAT(to_svg(kick({-1.6, 3.0, 0.0}, {2.0, 0.0, 0.0})), HasSubstr("The segments meet: aligned."));
  const std::string beside = to_svg(kick({-1.6, 3.0, 0.0}, {0.0, 0.0, 0.0}));
  EXPECT_THAT(beside, HasSubstr("The segments do not meet: not aligned."));
  const DrawnScale scale(beside);
  const auto target = lines(beside, "c4 wide").at(0);
  EXPECT_NEAR(std::hypot(target.at(1).x - target.at(0).x, target[1].y - target[0].y), 1.6 * scale.px_per_m, 0.2);
}

TEST(KickPicture, EverythingIsANumberAndOnThePaper) {
  const std::regex place("(?:x|cx|x1|x2)=\"([^\"]*)\" (?:y|cy|y1|y2)=\"([^\"]*)\"");
  for (const double x : {-6.0, 0.0, 5.0}) {
    for (const double y : {-9.0, 0.0, 8.0}) {
      for (const double heading : {-1.0, 0.0, 0.4, 1.0}) {
        for (const double speed : {-2.0, 0.0, 3.0}) {
          const std::string svg = to_svg(kick({x, y, heading}, {speed, speed, speed}));
          EXPECT_THAT(svg, Not(testing::ContainsRegex("nan|inf[^o]")));
          for (std::sregex_iterator it(svg.begin(), svg.end(), place), end; it != end; ++it) {
            EXPECT_GE(std::stod((*it)[1]), 0.0) << (*it)[0];
            EXPECT_LE(std::stod((*it)[1]), 1000.0) << (*it)[0];
            EXPECT_GE(std::stod((*it)[2]), 0.0) << (*it)[0];
            EXPECT_LE(std::stod((*it)[2]), 576.0) << (*it)[0];
          }
        }
      }
    }
  }
}

TEST(KickPicture, RefusesAKickAwayFromTheGoal) {
  EXPECT_THROW(to_svg(kick({0.0, 3.0, 3.0}, {0.0, 0.0, 0.0})), std::invalid_argument);
}

}  // namespace
}  // namespace trivela::evaluator
