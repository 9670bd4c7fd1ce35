#include "evaluator/render/svg_chart.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <regex>

namespace trivela::evaluator {
namespace {

using testing::DoubleNear;
using testing::HasSubstr;
using testing::Pointwise;
using testing::ThrowsMessage;

TEST(RoundTicks, AreRoundAndEncloseTheData) {
  EXPECT_THAT(round_ticks(0.0, 9.1), Pointwise(DoubleNear(1e-12), {0, 2, 4, 6, 8, 10}));
  EXPECT_THAT(round_ticks(-60, 90), Pointwise(DoubleNear(1e-12), {-60, -40, -20, 0, 20, 40, 60, 80, 100}));
  for (double span = 1e-6; span < 1e6; span *= 1.37) {
    for (const double low : {-0.7 * span, 0.0, 12.3 * span}) {
      const auto ticks = round_ticks(low, low + span);
      EXPECT_LE(ticks.front(), low + 1e-6 * span);
      EXPECT_GE(ticks.back(), low + span - 1e-6 * span);
      EXPECT_GE(ticks.size(), 5u);
      EXPECT_LE(ticks.size(), 11u);
      const double step = ticks[1] - ticks[0];
      const double mantissa = step / std::pow(10.0, std::floor(std::log10(step) + 1e-9));
      EXPECT_TRUE(std::abs(mantissa - 1) < 1e-6 || std::abs(mantissa - 2) < 1e-6 || std::abs(mantissa - 5) < 1e-6)
          << step;
    }
  }
}

TEST(RoundTicks, OfASinglePointHaveAWidth) {
  for (const double value : {0.0, 7.0, -1e6}) {
    const auto ticks = round_ticks(value, value);
    EXPECT_LE(ticks.front(), value);
    EXPECT_GT(ticks.back(), ticks.front());
  }
}

Chart chart(std::size_t series) {
  Chart chart{"a < b & c", "x [m]", "y [m]", {}};
  for (std::size_t i = 0; i < series; ++i) {
    chart.series.push_back({"p" + std::to_string(i), {{0, 0}, {1, double(i)}}, ChartMark::kLine, int(i), int(i % 5)});
  }
  return chart;
}

TEST(SvgChart, HasUnitsLegendAndADarkMode) {
  const std::string svg = to_svg(chart(3));
  for (const char* const part : {"x [m]", "y [m]", ">p0<", ">p2<", "prefers-color-scheme:dark", "a &lt; b &amp; c"}) {
    EXPECT_THAT(svg, HasSubstr(part));
  }
}

TEST(SvgChart, KeepsLegendEntriesApartAndInside) {
  for (const std::size_t series : {1u, 21u, 22u, 64u}) {
    const std::string svg = to_svg(chart(series));
    std::smatch size;
    ASSERT_TRUE(std::regex_search(svg, size, std::regex("viewBox=\"0 0 (\\d+) (\\d+)\"")));
    std::vector<std::pair<double, double>> places;
    const std::regex entry("<text x=\"([\\d.]+)\" y=\"([\\d.]+)\" text-anchor=\"start\">p");
    for (std::sregex_iterator it(svg.begin(), svg.end(), entry), end; it != end; ++it) {
      places.emplace_back(std::stod((*it)[1]), std::stod((*it)[2]));
    }
    ASSERT_EQ(places.size(), series);
    for (std::size_t i = 0; i < places.size(); ++i) {
      EXPECT_LT(places[i].first + 24.0, std::stod(size[1]));
      EXPECT_LT(places[i].second, std::stod(size[2]));
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_TRUE(std::abs(places[i].second - places[j].second) >= 16 ||
                    std::abs(places[i].first - places[j].first) >= 60);
      }
    }
  }
}

TEST(SvgChart, DrawsEveryPointInsideTheAxes) {
  const std::string svg = to_svg({"t", "x", "y", {{"dots", {{-3, 1e-5}, {12, 7e-5}}, ChartMark::kDots, 0, 0}}});
  const std::regex dot("<circle class=\"c0\" cx=\"([\\d.]+)\" cy=\"([\\d.]+)\"");
  int dots = 0;
  for (std::sregex_iterator it(svg.begin(), svg.end(), dot), end; it != end; ++it) {
    if (++dots > 2) break;  // the third is the legend's
    EXPECT_GE(std::stod((*it)[1]), 76);
    EXPECT_LE(std::stod((*it)[1]), 736);
    EXPECT_GE(std::stod((*it)[2]), 48);
    EXPECT_LE(std::stod((*it)[2]), 468);
  }
  EXPECT_EQ(dots, 3);
}

TEST(SvgChart, CategoriesHaveBandsAndNoScale) {
  const Chart chart{"t", "table", "y", {{"a", {{0, 1}, {1, 2}}, ChartMark::kDots}}, {"old", "new"}, true};
  const std::string svg = to_svg(chart);
  EXPECT_THAT(svg, HasSubstr("<text x=\"241.0\" y=\"488.0\" text-anchor=\"middle\">old</text>"));
  EXPECT_THAT(svg, HasSubstr("<text x=\"571.0\" y=\"488.0\" text-anchor=\"middle\">new</text>"));
  EXPECT_THAT(svg, HasSubstr("cx=\"241.0\""));
  EXPECT_THAT(svg, testing::Not(HasSubstr(">0.2<")));
  EXPECT_THAT(svg, HasSubstr("simulated: "));
}

TEST(SvgChart, OneValueStandsWithinTicksOfItsOwnSize) {
  EXPECT_THAT(round_ticks(0.5, 0.5), Pointwise(DoubleNear(1e-12), {0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8}));
  EXPECT_THAT(round_ticks(0.0, 0.0), Pointwise(DoubleNear(1e-12), {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}));
}

TEST(SvgChart, RefusesWhatCannotBeDrawn) {
  EXPECT_THAT([] { to_svg({"t", "x", "y", {}}); }, ThrowsMessage<std::invalid_argument>("chart: no points"));
  const Chart nan{"t", "x", "y", {{"s", {{0, std::numeric_limits<double>::quiet_NaN()}}, ChartMark::kLine, 0, 0}}};
  EXPECT_THAT([&] { to_svg(nan); }, ThrowsMessage<std::invalid_argument>("chart: a point is not finite"));
}

}  // namespace
}  // namespace trivela::evaluator
