#include "evaluator/counting/log_design.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace trivela::evaluator {
namespace {

// match, calibration, id, setting
using Situation = std::tuple<std::uint32_t, std::uint32_t, std::uint64_t, std::uint32_t>;

Situation situation_of(const Opportunity& o) { return {o.match, o.calibration, o.id, o.setting}; }

// Did several groups have the same opportunity?
bool share_opportunities(const KickDataset& dataset) {
  std::map<Situation, std::uint32_t> first_group;
  for (const Opportunity& o : dataset.opportunities) {
    if (o.id != 0 && first_group.try_emplace(situation_of(o), o.group).first->second != o.group) return true;
  }
  return false;
}

void infer_drawn(KickDataset& dataset, const LoggedOpportunities& logged, const std::vector<std::size_t>& rows) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::set<double>> chances;  // by group and stratum
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Opportunity& o = dataset.opportunities[i];
    chances[{o.group, o.stratum}].insert(*logged.rows[rows[i]].probability);
  }
  if (std::ranges::any_of(chances, [](const auto& chance) { return chance.second.size() > 1; })) {
    dataset.design_reason = fmt::format(
        "drawn at random, but not everywhere with the same probability: together, {} also differ in where they were "
        "drawn; compare within it (stratified by arm), or weigh with trivela study evaluate-policy",
        fmt::join(dataset.groups, " and "));
    return;
  }
  dataset.design = Design::kRandomised;
  dataset.design_reason = "the log has the probability with which each possession's policy was drawn";
  if (chances.size() != dataset.groups.size()) return;
  std::vector<double> shares;
  double sum = 0.0;
  for (const auto& [group, chance] : chances) {
    shares.push_back(*chance.begin());
    sum += shares.back();
  }
  if (std::abs(sum - 1.0) < 1e-6) dataset.planned_shares = shares;
}

// Who played when: the groups of each half of a match, and of each robot.
struct WhoPlayed {
  std::map<std::uint32_t, std::map<int, std::set<std::uint32_t>>> by_match_and_half;
  std::map<int, std::set<std::uint32_t>> by_robot;

  WhoPlayed(const KickDataset& dataset, const LoggedOpportunities& logged, const std::vector<std::size_t>& rows) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Opportunity& o = dataset.opportunities[i];
      by_match_and_half[o.match][logged.rows[rows[i]].half].insert(o.group);
      by_robot[logged.rows[rows[i]].robot_id].insert(o.group);
    }
  }

  bool always_alone() const {
    return std::ranges::all_of(by_robot, [](const auto& of) { return of.second.size() == 1; });
  }
  bool each_with_all(std::size_t groups) const {
    return std::ranges::all_of(by_robot, [&](const auto& of) { return of.second.size() == groups; });
  }
  bool side_by_side() const {
    return std::ranges::any_of(by_match_and_half, [](const auto& match) {
      return std::ranges::any_of(match.second, [](const auto& half) { return half.second.size() > 1; });
    });
  }
};

void infer_from_robots(KickDataset& dataset, const WhoPlayed& who) {
  if (who.each_with_all(dataset.groups.size())) {
    dataset.design = Design::kAlternating;
    dataset.design_reason = "side by side in the same matches, and each robot played with each";
  } else {
    dataset.design_reason =
        who.always_alone() ? "side by side in the same matches, each robot always with the same: the robots differ, too"
                           : "side by side in the same matches, but not every robot played with each";
  }
}

void infer_from_halves(KickDataset& dataset, const WhoPlayed& who, const std::string& by) {
  std::set<std::uint32_t> first, second;  // groups that had a first half alone, a second one
  for (const auto& [match, by_half] : who.by_match_and_half) {
    if (by_half.size() < 2 || by_half.begin()->second == by_half.rbegin()->second) continue;
    first.insert(by_half.begin()->second.begin(), by_half.begin()->second.end());
    second.insert(by_half.rbegin()->second.begin(), by_half.rbegin()->second.end());
  }
  if (!first.empty() && first == second) {
    dataset.design = Design::kAlternating;
    dataset.design_reason = "both halves were played with each";
  } else if (by == "robot") {
    dataset.design_reason = "robots play side by side but from other places";
  } else if (who.by_robot.size() > 1 && who.side_by_side()) {
    infer_from_robots(dataset, who);
  } else if (!first.empty()) {
    dataset.design_reason = "one after the other in every match, always in the same order of halves";
  } else {
    dataset.design_reason = "in different matches, or with different settings";
  }
}

}  // namespace

void infer_design(KickDataset& dataset, const LoggedOpportunities& logged, const std::vector<std::size_t>& rows,
                  const std::string& by, bool drawn) {
  if (drawn) return infer_drawn(dataset, logged, rows);
  if (std::ranges::all_of(logged.sessions, [](const ComparedSession& session) { return session.imported; })) {
    dataset.design_reason = "labels by hand do not say how the policies were assigned; --design does";
    return;
  }
  const bool numbered = std::ranges::all_of(
      logged.sessions, [](const ComparedSession& session) { return session.match_id && session.simulated; });
  const bool paired_halves = std::ranges::all_of(
      logged.sessions, [](const ComparedSession& session) { return session.paired_halves || !session.counts; });
  if (!(numbered || paired_halves) || !share_opportunities(dataset))
    return infer_from_halves(dataset, WhoPlayed(dataset, logged, rows), by);
  dataset.design = Design::kPaired;
  dataset.design_reason =
      numbered ? "the sessions have the same matches by number" : "the halves of each match have the same possessions";
}

void keep_first_of_paired_halves(KickDataset& dataset, const LoggedOpportunities& logged,
                                 std::vector<std::size_t>& rows) {
  std::map<std::pair<std::uint32_t, Situation>, int> first_half;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Opportunity& o = dataset.opportunities[i];
    const int half = logged.rows[rows[i]].half;
    const auto place = first_half.try_emplace({o.group, situation_of(o)}, half).first;
    place->second = std::min(place->second, half);
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Opportunity& o = dataset.opportunities[i];
    const LoggedOpportunity& row = logged.rows[rows[i]];
    const bool again = logged.sessions[row.session].paired_halves && o.id != 0 &&
                       first_half.at({o.group, situation_of(o)}) != row.half;
    if (again) continue;
    dataset.opportunities[kept] = o;
    rows[kept++] = rows[i];
  }
  if (kept < rows.size())
    dataset.remarks.push_back(
        fmt::format("{} opportunities left out: the same situations in a later half", rows.size() - kept));
  dataset.opportunities.resize(kept);
  rows.resize(kept);
}

void keep_common_settings(KickDataset& dataset, const std::string& by) {
  std::map<std::uint32_t, std::set<std::uint32_t>> groups_of;  // by setting
  std::set<std::pair<std::uint32_t, Situation>> seen;
  for (const Opportunity& o : dataset.opportunities) {
    groups_of[o.setting].insert(o.group);
    if (o.id == 0 || seen.insert({o.group, situation_of(o)}).second) continue;
    throw std::runtime_error(fmt::format(
        "{0} '{1}' was played twice on the same opportunities, in sessions that differ: {2}, or leave a log out", by,
        dataset.groups[o.group], by == "arm" ? "give each its own arm" : "compare by arm"));
  }
  const auto common = [&](std::uint32_t setting) { return groups_of[setting].size() == dataset.groups.size(); };
  if (std::ranges::none_of(groups_of, [&](const auto& of) { return common(of.first); })) {
    throw std::runtime_error(
        fmt::format("no {} was played with each {} ({}): what differs between them is not the {} alone; compare by arm",
                    by == "table" ? "policy with the same settings" : "table with the same settings", by,
                    fmt::join(dataset.groups, ", "), by));
  }
  std::vector<std::int64_t> left_out(dataset.groups.size());
  std::erase_if(dataset.opportunities, [&](const Opportunity& o) {
    left_out[o.group] += common(o.setting) ? 0 : 1;
    return !common(o.setting);
  });
  for (std::size_t i = 0; i < left_out.size(); ++i) {
    if (left_out[i] == 0) continue;
    dataset.remarks.push_back(
        fmt::format("{} opportunities of '{}' left out: their {} or settings were not played with every {}",
                    left_out[i], dataset.groups[i], by == "table" ? "policy" : "table", by));
  }
}

}  // namespace trivela::evaluator
