#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "evaluator/page/figures/figure.hpp"
#include "evaluator/page/html.hpp"
#include "evaluator/page/report_page.hpp"
#include "kicking/geometry/angle.hpp"

namespace trivela::evaluator::page {
namespace {

constexpr std::size_t kMostCourses = 12;
constexpr double kCourseLeft = 60.0, kCourseRight = 500.0, kCourseTop = 16.0, kCourseBottom = 196.0,
                 kCourseHeight = 250.0;
constexpr double kSd95 = 1.96;

/// A part of a kicker over the kicks.
struct Course {
  const char* id;
  const char* name;  ///< with its unit
  LearnedPart KickerStep::*part;
  double unit;
};
constexpr double kDegree_rad = kicking::radians(1.0);
constexpr Course kCourses[] = {{"speed", "exit speed, difference [%]", &KickerStep::speed_ln, 0.01},
                               {"angle", "exit angle, difference [deg]", &KickerStep::elevation_rad, kDegree_rad}};

/// The estimate as a line, its 95 % as a band.
std::string course_figure(const PageView& view, const LearnedKicker& kicker, const Course& course) {
  double low = 0.0, high = 0.0;
  for (const KickerStep& step : kicker.steps) {
    const LearnedPart& part = step.*course.part;
    low = std::min(low, (part.value - kSd95 * part.se) / course.unit);
    high = std::max(high, (part.value + kSd95 * part.se) / course.unit);
  }
  const Axis x = axis(0.0, static_cast<double>(kicker.kicks()), kCourseLeft, kCourseRight, "kicks seen");
  const Axis y = axis(low, high, kCourseBottom, kCourseTop, course.name);
  std::vector<ChartPoint> line, band, below;
  for (const KickerStep& step : kicker.steps) {
    const LearnedPart& part = step.*course.part;
    const double px = x.scale.px(static_cast<double>(step.kicks));
    line.push_back({px, y.scale.px(part.value / course.unit)});
    band.push_back({px, y.scale.px((part.value + kSd95 * part.se) / course.unit)});
    below.push_back({px, y.scale.px((part.value - kSd95 * part.se) / course.unit)});
  }
  const std::string kind = colour(static_cast<std::size_t>(kicker.robot_id));
  const std::string svg = axes(x, y) + svg_line("zero", kCourseLeft, y.scale.px(0.0), kCourseRight, y.scale.px(0.0)) +
                          svg_polyline(kind + " course band", band) + svg_polyline(kind + " course band", below) +
                          svg_polyline(kind + " course", line);
  return figure({fmt::format("learning-{}-{}-{}", course.id, kicker.session_id, kicker.robot_id),
                 fmt::format("{}: {} over the kicks", kicker.who(), course.name), kCourseHeight, view.simulated},
                svg, fmt::format("{}: difference from its file; dotted: 95 % of the estimate.", kicker.who()));
}

std::string with_error_text(const LearnedPart& part, double unit, int digits) {
  return fmt::format("{:+.{}f} ± {:.{}f}", part.value / unit, digits, part.se / unit, digits);
}

std::string steps_table(const LearnedKicker& kicker) {
  std::vector<std::vector<std::string>> rows{
      {"kicks seen", "kick_id", "exit speed, %", "exit angle, deg", "direction, deg", "delay, ms", "says nothing, p"}};
  for (const KickerStep& step : kicker.steps)
    rows.push_back({std::to_string(step.kicks), step.kick_id == 0 ? "-" : std::to_string(step.kick_id),
                    with_error_text(step.speed_ln, 0.01, 1), with_error_text(step.elevation_rad, kDegree_rad, 1),
                    with_error_text(step.direction_rad, kDegree_rad, 1), with_error_text(step.delay_s, 0.001, 0),
                    fmt::format("{:.2f}", step.p_mistaken)});
  return details(fmt::format("Every update of {}", kicker.who()),
                 table(fmt::format("The estimate of {} after each kick, with standard errors", kicker.who()), rows));
}

}  // namespace

std::string learning_section(const PageView& view) {
  const char* const title = "What kicks show of the kickers";
  const auto& kickers = view.report.kickers;
  if (kickers.empty())
    return section(
        "learning", title,
        paragraphs({"No kick was learned from: [self_calibration] was off, or no goal camera saw a flight."}));
  std::string body = paragraphs({"Differences of each kicker from its robot's file, as its own kicks show them."});
  for (std::size_t i = 0; i < std::min(kMostCourses, kickers.size()); ++i) {
    body += list_of(kickers[i].sentences());
    for (const Course& course : kCourses) body += course_figure(view, kickers[i], course);
    body += steps_table(kickers[i]);
  }
  if (kickers.size() > kMostCourses)
    body += paragraphs(
        {fmt::format("And {} more: trivela query LOG --metric kicker_updates.", kickers.size() - kMostCourses)});
  return section("learning", title, body);
}

}  // namespace trivela::evaluator::page
