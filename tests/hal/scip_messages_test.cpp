#include "hal/scip/messages.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "hal/scip/reply.hpp"
#include "tests/hal/scip_text.hpp"

namespace trivela::hal::scip {
namespace {

using std::numbers::pi;

Reply reply_of(const std::string& text) {
  ReplyParser parser;
  const auto replies = parser.feed(text);
  return replies.size() == 1 ? replies.front() : Reply{};
}

TEST(ScipMessages, RequestsAreThoseOfTheSpecification) {
  EXPECT_EQ(measure_request({0, 1080, 0}), "MD0000108000000");
  EXPECT_EQ(measure_request({44, 725, 1}, 2, 7), "MD0044072501207");
  EXPECT_EQ(get_request({44, 725, 12}), "GD0044072512");
}

TEST(ScipMessages, BeamsOfASectionWithClusters) {
  EXPECT_EQ(beams({44, 725, 1}), 682U);
  EXPECT_EQ(beams({44, 725, 0}), 682U);
  EXPECT_EQ(beams({0, 9, 3}), 4U);
  EXPECT_EQ(beams({0, 8, 3}), 3U);
}

TEST(ScipMessages, IdentityOfAnUrg) {
  const auto identity = identity_of(reply_of(tests::urg_version()));
  ASSERT_TRUE(identity);
  EXPECT_EQ(identity->vendor, "Hokuyo Automatic Co.,Ltd.");
  EXPECT_EQ(identity->product, "SOKUIKI Sensor URG-04LX");
  EXPECT_EQ(identity->serial, "H0508486");
  EXPECT_EQ(identity->firmware, "3.3.00(16/Apr./2008)");
  EXPECT_EQ(identity->protocol, "SCIP 2.0");
  EXPECT_FALSE(identity_of(reply_of(tests::urg_parameters())));
}

TEST(ScipMessages, GeometryOfAnUrg) {
  const auto parameters = parameters_of(reply_of(tests::urg_parameters()));
  ASSERT_TRUE(parameters);
  const auto geometry = geometry_of(*parameters);
  EXPECT_EQ(geometry.beams, 682U);
  EXPECT_DOUBLE_EQ(geometry.step_rad, 2.0 * pi / 1024);
  EXPECT_DOUBLE_EQ(geometry.first_angle_rad, (44 - 384) * 2.0 * pi / 1024);
  EXPECT_DOUBLE_EQ(geometry.scan_period_s, 0.1);
  EXPECT_DOUBLE_EQ(geometry.beam_period_s, 0.1 / 1024);
  EXPECT_DOUBLE_EQ(geometry.min_range_m, 0.020);
  EXPECT_DOUBLE_EQ(geometry.max_range_m, 5.6);
}

TEST(ScipMessages, TheDefaultGeometryIsThatOfAUtmAndComesBackFromItsParameters) {
  const kicking::lob::ScanGeometry utm;
  for (const int first_step : {0, 5}) {
    const Parameters p = parameters_for(utm, first_step, "UTM-30LX");
    EXPECT_EQ(p.front_step, 540 + first_step);
    EXPECT_EQ(p.last_step, 1080 + first_step);
    EXPECT_EQ(p.steps_per_turn, 1440);
    EXPECT_EQ(p.speed_rpm, 2400);
    const auto geometry = geometry_of(p);
    EXPECT_EQ(geometry.beams, utm.beams);
    EXPECT_DOUBLE_EQ(geometry.first_angle_rad, utm.first_angle_rad);
    EXPECT_DOUBLE_EQ(geometry.step_rad, utm.step_rad);
    EXPECT_DOUBLE_EQ(geometry.scan_period_s, utm.scan_period_s);
    EXPECT_DOUBLE_EQ(geometry.beam_period_s, utm.beam_period_s);
  }
}

TEST(ScipMessages, ValuesMayStandAfterBlanks) {
  EXPECT_EQ(parameters_of(reply_of(tests::urg_parameters("  5600")))->max_range_mm, 5600);
}

TEST(ScipMessages, ParametersOfNoScannerAreRefused) {
  for (const std::string dmax : {"", "x", "5600x", "-5", "20", "99999999999999999999", "5600.0"}) {
    EXPECT_FALSE(parameters_of(reply_of(tests::urg_parameters(dmax)))) << dmax;
  }
  for (const std::string amax : {"43", "10000", "1068", "-1"}) {
    EXPECT_FALSE(parameters_of(reply_of(tests::urg_parameters("5600", amax)))) << amax;
  }
  EXPECT_TRUE(parameters_of(reply_of(tests::urg_parameters("5600", "1067"))));
  EXPECT_FALSE(parameters_of(reply_of(plain_reply("PP", "00", text_line("DMIN", "20")))));
  EXPECT_FALSE(parameters_of(reply_of(plain_reply("PP", "0A"))));
}

TEST(ScipMessages, StateOfAScanner) {
  const auto state = state_of(reply_of(
      plain_reply("II", "00", text_line("LASR", "ON") + text_line("MESM", "Idle") + text_line("STAT", "works well"))));
  ASSERT_TRUE(state);
  EXPECT_TRUE(state->laser_on);
  EXPECT_EQ(state->measurement, "Idle");
  EXPECT_EQ(state->condition, "works well");
}

TEST(ScipMessages, ErrorCodesStayAndANumberOfValuesThatDoesNotFitIsRefused) {
  Reply reply;
  for (std::uint32_t code = 0; code < 30; ++code) reply.data += encode(code, 3);
  const auto ranges = ranges_of(reply, 30);
  ASSERT_TRUE(ranges);
  for (std::uint32_t code = 0; code < 30; ++code) EXPECT_EQ((*ranges)[code], code);
  EXPECT_FALSE(ranges_of(reply, 29));
  EXPECT_FALSE(ranges_of(reply, 31));
}

TEST(ScipMessages, AStatusMeansSomethingDependingOnTheRequest) {
  EXPECT_EQ(meaning("BM", "02"), "the laser was on already");
  EXPECT_EQ(meaning("MD0000108001000", "02"), "the end step is no number");
  EXPECT_EQ(meaning("GD0000108001", "10"), "the laser is off");
  EXPECT_EQ(meaning("MD", "21"), meaning("MD", "49"));
  EXPECT_EQ(meaning("MD", "50"), "the scanner has a fault in its hardware");
  EXPECT_EQ(meaning("XX", "0E"), "the scanner does not know the request");
  EXPECT_EQ(meaning("VV", "77"), "status 77");
}

}  // namespace
}  // namespace trivela::hal::scip
