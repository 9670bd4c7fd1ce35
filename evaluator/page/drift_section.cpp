#include <fmt/format.h>

#include <map>
#include <tuple>

#include "evaluator/page/html.hpp"
#include "evaluator/page/report_page.hpp"

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
  const char* const title = "Is a kicker drifting?";
  const auto& robots = view.data.drift.robots;
  if (robots.empty())
    return section("drift", title, paragraphs({"There is no kick that the kicker's driver accepted."}));
  const LinkedKicks places(view.data);
  std::string changed, same;
  std::size_t without = 0;
  for (const RobotDrift& robot : robots) {
    changed += changed_items(robot, places);
    if (robot.timeline.drifts.empty() && ++without <= kMostUnchanged) same += unchanged_item(robot);
  }
  if (without > kMostUnchanged)
    same += fmt::format("<li>and {} more without a change</li>\n", without - kMostUnchanged);
  const std::string body = "<ul>\n" + changed + same + "</ul>\n";
  return section(
      "drift", title,
      body + paragraphs({"Crossing heights and exit speeds against what the robot itself predicted, kick by "
                         "kick; trivela drift LOG says the same. About once in 2,000 kicks a change is found "
                         "where there was none."}));
}

}  // namespace trivela::evaluator::page
