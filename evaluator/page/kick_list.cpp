#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <set>

#include "evaluator/page/figures/figure.hpp"
#include "evaluator/page/html.hpp"
#include "evaluator/page/report_page.hpp"
#include "evaluator/render/text_table.hpp"
#include "kicking/geometry/time.hpp"

namespace trivela::evaluator::page {
namespace {

constexpr std::int64_t kFirstUtc_ns = 1'000'000'000'000'000'000;  // 2001: a clock that is earlier is a simulator's

std::string crossing_text(const std::optional<TimelineEnd>& end) {
  if (!end || (!end->x_m && !end->z_m)) return "–";
  const auto number = [](const std::optional<double>& m, const char* form) {
    return m ? fmt::format(fmt::runtime(form), *m) : std::string("–");
  };
  std::string text = number(end->x_m, "{:+.2f}") + ", " + number(end->z_m, "{:.2f}");
  if (end->sd_m) text += fmt::format(" ± {:.2f}", *end->sd_m);
  return text;
}

std::string choice(const std::string& key, const std::string& label, const std::set<std::string>& values) {
  std::string text = fmt::format("<label>{} <select data-filter=\"{}\"><option value=\"\">all</option>", label, key);
  for (const std::string& value : values)
    text += fmt::format("<option value=\"{0}\">{1}</option>", html(value), html(words(value)));
  return text + "</select></label>\n";
}

std::string filter_form(const std::vector<PageKick>& kicks) {
  std::set<std::string> policies, robots, halves, outcomes, logs;
  for (const PageKick& kick : kicks) {
    policies.insert(kick.timeline.policy);
    robots.insert(std::to_string(kick.timeline.robot_id));
    halves.insert(std::to_string(kick.timeline.half));
    outcomes.insert(outcome_words(kick.timeline));
    logs.insert(std::to_string(kick.log + 1));
  }
  std::string form = "<form id=\"filter\" hidden aria-label=\"Filter of the list of kicks\">\n";
  form += choice("policy", "policy", policies) + choice("robot", "robot", robots) + choice("half", "half", halves);
  form += choice("outcome", "outcome", outcomes);
  if (logs.size() > 1) form += choice("log", "log", logs);
  form += "<label>from <input type=\"number\" data-filter=\"near\" min=\"0\" max=\"20\" step=\"0.5\"> m</label>\n";
  form += "<label>to <input type=\"number\" data-filter=\"far\" min=\"0\" max=\"20\" step=\"0.5\"> m</label>\n";
  form += "<button type=\"reset\">all kicks</button>\n<output id=\"shown\" aria-live=\"polite\"></output>\n</form>\n";
  return form;
}

std::string cell(const std::string& text) { return "<td>" + html(text) + "</td>"; }

std::string row_of(std::size_t number, const PageKick& kick, bool several_logs, bool replays) {
  const KickTimeline& timeline = kick.timeline;
  std::string row = fmt::format(
      "<tr id=\"k{}\" data-policy=\"{}\" data-robot=\"{}\" data-half=\"{}\" data-outcome=\"{}\" data-log=\"{}\" "
      "data-distance=\"{:.2f}\">",
      number, html(timeline.policy), timeline.robot_id, timeline.half, html(outcome_words(timeline)), kick.log + 1,
      timeline.distance_m);
  row += fmt::format("<th scope=\"row\">{}:{}</th>", timeline.robot_id, timeline.number);
  if (several_logs) row += cell(std::to_string(kick.log + 1));
  row += cell(instant_text(timeline)) + cell(match_time_text(timeline)) + cell(timeline.policy);
  row += cell(timeline.distance_m > 0.0 ? fmt::format("{:.2f}", timeline.distance_m) : "–");
  row += cell((timeline.power ? fmt::format("{:.1f}", *timeline.power) : "–") +
              (timeline.kick_kind > 0 ? fmt::format(", kind {}", timeline.kick_kind + 1) : ""));
  row += cell(crossing_text(timeline.predicted)) + cell(crossing_text(timeline.observed));
  row += fmt::format("<td class=\"outcome {}\">{}</td>", kOutcomeNames[static_cast<std::size_t>(kind_of(timeline))].key,
                     html(outcome_words(timeline)));
  if (replays)
    row += fmt::format(
        "<td class=\"hand\"><button type=\"button\" data-replay=\"{}\" hidden aria-label=\"Replay kick "
        "{}:{}\">replay</button></td>",
        number, timeline.robot_id, timeline.number);
  return row + "</tr>\n";
}

std::string list(const std::vector<PageKick>& kicks, bool several_logs, bool replays) {
  std::string text =
      "<div class=\"scrolls\" role=\"group\" aria-label=\"List of kicks\" tabindex=\"0\">\n<table "
      "id=\"kicks\">\n<caption>Kicks</caption>\n<thead><tr>";
  for (const char* const head : {"kick", "log", "UTC", "half, time", "policy", "distance [m]", "power",
                                 "predicted x, z [m]", "observed x, z [m]", "outcome"}) {
    if (std::string_view(head) != "log" || several_logs) text += fmt::format("<th scope=\"col\">{}</th>", head);
  }
  text += replays ? "<td></td></tr></thead>\n<tbody>\n" : "</tr></thead>\n<tbody>\n";
  for (std::size_t i = 0; i < kicks.size(); ++i) text += row_of(i, kicks[i], several_logs, replays);
  return text + "</tbody>\n</table>\n</div>\n";
}

}  // namespace

std::string instant_text(const KickTimeline& timeline) {
  if (timeline.utc_ns < kFirstUtc_ns) return fmt::format("{:+.2f} s", kicking::seconds(timeline.t_ns));
  return fmt::format("{:%Y-%m-%d %H:%M:%S}.{:02}", fmt::gmtime(std::time_t{timeline.utc_ns / 1'000'000'000}),
                     timeline.utc_ns / 10'000'000 % 100);
}

std::string match_time_text(const KickTimeline& timeline) {
  if (!timeline.half_time_s || !std::isfinite(*timeline.half_time_s)) return fmt::format("{}", timeline.half);
  const auto tenths = std::llround(10.0 * std::clamp(*timeline.half_time_s, 0.0, 1e6));
  return fmt::format("{}, {}:{:02}.{}", timeline.half, tenths / 600, tenths / 10 % 60, tenths % 10);
}

std::string kick_list_section(const PageView& view) {
  const auto& kicks = view.data.kicks;
  if (kicks.empty()) return paragraphs({"There are no kicks."});
  if (view.data.binned())
    return paragraphs(
        {fmt::format("{} kicks are too many for a list: a page lists up to {}. trivela query LOG --metric "
                     "listed_kicks --csv has them all, and a report of one match has its replays.",
                     kicks.size(), kMostKicks)});
  const bool replays = kicks.size() <= kMostReplays;
  std::vector<std::string> notes{
      "x is to the right of the goal's middle, z the height of the ball's centre, both where it crosses the goal line. "
      "A time like +12.30 s stands where a simulated clock knows no UTC."};
  if (!replays)
    notes.push_back(
        fmt::format("Above {} kicks the list has no replays: a report of one match has them.", kMostReplays));
  std::string body = filter_form(kicks);
  if (replays)
    body += fmt::format(
        "<div id=\"replay\" hidden tabindex=\"-1\" aria-label=\"Replay\" role=\"group\"><div "
        "id=\"replay-words\"></div><div id=\"replay-stage\"></div>{}<button type=\"button\" id=\"replay-close\">close "
        "the replay</button></div>\n",
        view.simulated ? fmt::format("<p class=\"simulated\">{}</p>", kSimulatedFigure) : "");
  body += list(kicks, view.data.logs.size() > 1, replays) + paragraphs(notes);
  if (replays)
    body += "<noscript><p>Filter and replay need JavaScript; everything else on this page does not.</p></noscript>\n";
  return body;
}

}  // namespace trivela::evaluator::page
