#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "evaluator/page/figures/figure.hpp"
#include "evaluator/page/html.hpp"
#include "evaluator/page/report_page.hpp"
#include "kicking/geometry/angle.hpp"

namespace trivela::evaluator::page {
namespace {

constexpr std::size_t kMostUnchanged = 20;  // kickers without a change that are named one by one

/// Log, session, robot and kick.
using ListedKick = std::tuple<std::size_t, std::int64_t, int, std::int64_t>;

/// Where kicks stand in the list.
class LinkedKicks {
 public:
  explicit LinkedKicks(const PageData& data) : kicks_(data.kicks) {
    if (data.binned()) return;
    for (std::size_t i = 0; i < kicks_.size(); ++i) {
      const KickTimeline& timeline = kicks_[i].timeline;
      places_[{kicks_[i].log, timeline.session_id, timeline.robot_id, timeline.kick_id}] = i;
    }
  }

  /// The kick by its name in the list, with its instant, as a link where there is such a list.
  std::string link(int robot_id, const DriftKick& kick) const {
    const auto found = places_.find({kick.log, kick.session_id, robot_id, kick.kick_id});
    if (found == places_.end()) return fmt::format("kick_id {}", kick.kick_id);
    const KickTimeline& timeline = kicks_[found->second].timeline;
    return fmt::format("kick <a href=\"#k{}\">{}:{}</a> ({})", found->second, timeline.robot_id, timeline.number,
                       html(instant_text(timeline)));
  }

 private:
  const std::vector<PageKick>& kicks_;
  std::map<ListedKick, std::size_t> places_;
};

std::string kicker_head(const RobotDrift& robot) {
  return html(fmt::format("robot {}{}, {}", robot.robot_id,
                          robot.simulated ? fmt::format(" of session {}", robot.kicks.front().session) : "",
                          counted(std::ssize(robot.kicks), "kick", "kicks")));
}

std::string changed_items(const RobotDrift& robot, const LinkedKicks& places) {
  std::string text;
  for (const Drift& drift : robot.timeline.drifts) {
    text += fmt::format("<li>{}: changed at {}: {}; certain with {}. What to do: {}.</li>\n", kicker_head(robot),
                        places.link(robot.robot_id, robot.kicks[drift.changed]), html(words_of(drift)),
                        places.link(robot.robot_id, robot.kicks[drift.found]), html(correction_of(drift)));
  }
  return text;
}

std::string unchanged_item(const RobotDrift& robot) {
  const DriftRule rule;
  const auto judged = static_cast<std::size_t>(rule.height.quiet);
  const DriftLevel& level = robot.timeline.level;
  if (level.heights > judged)
    return fmt::format("<li>{}: no change found; {}</li>\n", kicker_head(robot), html(level_words(level)));
  return fmt::format(
      "<li>{}: too few kicks to say: the height of {} was seen, and a change is looked for after the "
      "first {} of a policy</li>\n",
      kicker_head(robot), level.heights, judged);
}

}  // namespace

std::string drift_section(const PageView& view) {
  const auto& robots = view.data.drift.robots;
  if (robots.empty()) return paragraphs({"There is no kick that the kicker's driver accepted."});
  const LinkedKicks places(view.data);
  std::string changed, same;
  std::size_t without = 0;
  for (const RobotDrift& robot : robots) {
    changed += changed_items(robot, places);
    if (robot.timeline.drifts.empty() && ++without <= kMostUnchanged) same += unchanged_item(robot);
  }
  if (without > kMostUnchanged)
    same += fmt::format("<li>and {} more without a change</li>\n", without - kMostUnchanged);
  return "<ul>\n" + changed + same + "</ul>\n" +
         paragraphs({"Crossing heights and exit speeds against what the robot itself predicted, kick by kick; trivela "
                     "drift LOG says the same. About once in 2,000 kicks a change is found where there was none."});
}

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
  const auto& kickers = view.report.kickers;
  if (kickers.empty())
    return paragraphs({"No kick was learned from: [self_calibration] was off, or no goal camera saw a flight."});
  std::string body = paragraphs({"Differences of each kicker from its robot's file, as its own kicks show them."});
  for (std::size_t i = 0; i < std::min(kMostCourses, kickers.size()); ++i) {
    body += list_of(kickers[i].sentences());
    for (const Course& course : kCourses) body += course_figure(view, kickers[i], course);
    body += steps_table(kickers[i]);
  }
  if (kickers.size() > kMostCourses)
    body += paragraphs(
        {fmt::format("And {} more: trivela query LOG --metric kicker_updates.", kickers.size() - kMostCourses)});
  return body;
}

}  // namespace trivela::evaluator::page
