#include "experiment/effects/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "evaluator/report/simulated.hpp"
#include "evaluator/report/text_table.hpp"
#include "experiment/effects/render.hpp"

namespace trivela::experiment {
namespace {

constexpr const char* kNotThere =
    "Not there, since this book keeps the sums of each match alone: decisions, why a kick missed (but for the blocked\n"
    "ones), crossings, distances, and which opportunities two arms took alike.\n";

Effect difference(const Summary& summary, std::size_t arm, Measure measure) {
  const Term terms[] = {{&summary.arms[arm].matches, 1.0}, {&summary.arms.front().matches, -1.0}};
  return contrast(terms, measure);
}

std::string heading(const Summary& summary) {
  return fmt::format("{}Book of tallies: {} matches of each arm{}; {}.\n\n", evaluator::kSimulated, summary.matches,
                     summary.matches < summary.asked ? fmt::format(" of {} that were asked for", summary.asked) : "",
                     interval_words(summary.evenings));
}

}  // namespace

std::string label_warning(const std::string& arm, const ArmTally& observed) {
  if (total_of(observed).kicks == 0) return {};
  ArmTally truth = observed;
  for (MatchTally& match : truth) match.on_target = match.true_on_target;
  const Effect said = share_of(observed, Measure::kPerOpportunity), is = share_of(truth, Measure::kPerOpportunity);
  if (!has_interval(said) || (is.value >= said.ci.lo && is.value <= said.ci.hi)) return {};
  return fmt::format(
      "{}: the observer's labels are wrong: {:.4f} ({:.4f} to {:.4f}) on target an opportunity by them, {:.4f} by the "
      "simulator's truth\n",
      arm, said.value, said.ci.lo, said.ci.hi, is.value);
}

MatchTally tally_of(const evaluator::log::MatchCounts& counts) {
  return {.opportunities = counts.opportunities,
          .kicks = counts.kicks,
          .on_target = counts.on_target,
          .blocked = counts.blocked,
          .bounced = counts.bounced,
          .goals = counts.goals,
          .calibration = static_cast<std::uint32_t>(counts.calibration_id),
          .true_on_target = counts.true_on_target};
}

Summary summary_of(const evaluator::log::Book& book, bool blocked_apart) {
  Summary summary;
  summary.asked = book.matches;
  if (blocked_apart) summary.efficiency = Measure::kUnblocked;
  const auto in_all = [&](std::uint32_t match) {
    return std::ranges::all_of(book.arms, [&](const auto& arm) { return arm.matches.contains(match); });
  };
  for (const evaluator::log::BookArm& arm : book.arms) {
    Summary::Arm& added = summary.arms.emplace_back(Summary::Arm{arm.name, {}});
    for (const auto& [match, counts] : arm.matches) {
      if (in_all(match)) added.matches.push_back(tally_of(counts));
    }
  }
  if (summary.arms.empty() || summary.arms.front().matches.empty())
    throw std::invalid_argument{"the arms of this book have no match in common"};
  std::set<std::uint32_t> evenings;
  for (const MatchTally& match : summary.arms.front().matches) evenings.insert(match.calibration);
  summary.evenings = evenings.size() > 1 ? evenings.size() : 0;
  summary.matches = static_cast<std::int64_t>(summary.arms.front().matches.size());
  return summary;
}

bool put_first(Summary& summary, const std::string& arm) {
  const auto found = std::ranges::find(summary.arms, arm, &Summary::Arm::name);
  if (found == summary.arms.end()) return false;
  std::rotate(summary.arms.begin(), found, found + 1);
  return true;
}

std::string to_text(const Summary& summary) {
  std::vector<std::vector<std::string>> rows{{"arm", "opportunities", "kicks", "on target", "blocked", "efficiency [%]",
                                              "on target/opp. [%]", "goals/opp. [%]"}};
  for (const Summary::Arm& arm : summary.arms) {
    const MatchTally total = total_of(arm.matches);
    rows.push_back({arm.name, fmt::format("{}", total.opportunities), fmt::format("{}", total.kicks),
                    fmt::format("{}", total.on_target), fmt::format("{}", total.blocked),
                    share_text(share_of(arm.matches, summary.efficiency)),
                    share_text(share_of(arm.matches, Measure::kPerOpportunity)),
                    share_text(share_of(arm.matches, Measure::kGoals))});
  }
  std::string text = heading(summary) + evaluator::text_table(rows) +
                     "  goals: by the simulator's truth, on target and past the keeper where there is one\n";
  for (const Summary::Arm& arm : summary.arms) text += label_warning(arm.name, arm.matches);
  if (summary.arms.size() > 1) {
    rows = {{"minus " + summary.arms.front().name, "efficiency [points]", "on target/opp. [points]"}};
    for (std::size_t i = 1; i < summary.arms.size(); ++i)
      rows.push_back({summary.arms[i].name, points_text(difference(summary, i, summary.efficiency)),
                      points_text(difference(summary, i, Measure::kPerOpportunity))});
    text += "\nOn the same matches:\n" + evaluator::text_table(rows);
  }
  return text + '\n' + kNotThere;
}

nlohmann::ordered_json to_json(const Summary& summary) {
  evaluator::Json json{{"simulated", true},
                       {"matches", summary.matches},
                       {"matches_asked", summary.asked},
                       {"evenings", summary.evenings},
                       {"arms", evaluator::Json::array()}};
  for (std::size_t i = 0; i < summary.arms.size(); ++i) {
    const Summary::Arm& arm = summary.arms[i];
    const MatchTally total = total_of(arm.matches);
    evaluator::Json entry{{"arm", arm.name},
                          {"opportunities", total.opportunities},
                          {"kicks", total.kicks},
                          {"on_target", total.on_target},
                          {"blocked", total.blocked},
                          {"goals", total.goals},
                          {"efficiency", json_of(share_of(arm.matches, summary.efficiency))},
                          {"on_target_per_opportunity", json_of(share_of(arm.matches, Measure::kPerOpportunity))}};
    if (i > 0) {
      entry["minus_first"] = {{"efficiency", json_of(difference(summary, i, summary.efficiency))},
                              {"on_target_per_opportunity", json_of(difference(summary, i, Measure::kPerOpportunity))}};
    }
    json["arms"].push_back(std::move(entry));
  }
  return json;
}

std::string to_csv(const Summary& summary) {
  std::string csv =
      "arm,matches,opportunities,kicks,on_target,blocked,goals,efficiency,efficiency_low,efficiency_high,"
      "per_opportunity,per_opportunity_low,per_opportunity_high,simulated\n";
  for (const Summary::Arm& arm : summary.arms) {
    const MatchTally total = total_of(arm.matches);
    csv +=
        fmt::format("\"{}\",{},{},{},{},{},{},{},{},1\n", arm.name, summary.matches, total.opportunities, total.kicks,
                    total.on_target, total.blocked, total.goals, csv_cells(share_of(arm.matches, summary.efficiency)),
                    csv_cells(share_of(arm.matches, Measure::kPerOpportunity)));
  }
  return csv;
}

}  // namespace trivela::experiment
