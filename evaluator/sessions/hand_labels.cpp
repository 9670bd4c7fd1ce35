#include "evaluator/sessions/hand_labels.hpp"

#include <fmt/format.h>

#include <optional>

#include "evaluator/metrics/labels_by_hand.sql.hpp"

namespace trivela::evaluator {

bool disagree(const std::string& by_hand, const std::string& observed) {
  const auto on_target = [](const std::string& outcome) {
    return outcome == "goal" || outcome == "saved" || outcome == "on_target";
  };
  if (by_hand == "outside") return on_target(observed);
  if (!on_target(by_hand) || !on_target(observed)) return by_hand != observed;
  return by_hand != observed && by_hand != "on_target" && observed != "on_target";
}

HandLabels hand_labels_of(const log::Reader& reader, const std::set<std::int64_t>& sessions) {
  HandLabels labels;
  reader.query(kLabelsByHandSql, [&](const log::NamedCells& row) {
    const auto& outcome = row.get<std::string>("outcome");
    const auto observed = row.find<std::string>("observed");
    if (!sessions.contains(row.get<std::int64_t>("session_id"))) return;
    ++labels.kicks;
    if (!observed || *observed == "unknown") {
      ++labels.observer_knew_not;
    } else if (outcome != "unknown") {
      ++labels.compared;
      labels.disagreed += disagree(outcome, *observed) ? 1 : 0;
    }
  });
  return labels;
}

void HandLabels::add(const HandLabels& other) {
  kicks += other.kicks;
  compared += other.compared;
  disagreed += other.disagreed;
  observer_knew_not += other.observer_knew_not;
}

std::string HandLabels::line() const {
  if (kicks == 0) return "";
  return fmt::format("hand labels: {} kick{}; they disagreed with the observer in {} of {}, who did not know {}", kicks,
                     kicks == 1 ? "" : "s", disagreed, compared, observer_knew_not);
}

}  // namespace trivela::evaluator
