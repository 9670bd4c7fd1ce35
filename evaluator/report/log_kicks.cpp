#include "evaluator/report/log_kicks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <stdexcept>

namespace trivela::evaluator {
namespace {

using Name = std::function<std::string(const LoggedOpportunity&)>;  // empty: not known

// What a row is called by one of its columns. None: there is no such column.
std::optional<Name> name_by(const LoggedOpportunities& logged, const std::string& column) {
  const auto session = [&](const LoggedOpportunity& o) -> const ComparedSession& { return logged.sessions[o.session]; };
  if (column == "policy") return [](const LoggedOpportunity& o) { return o.policy; };
  if (column == "robot") return [](const LoggedOpportunity& o) { return fmt::format("robot {}", o.robot_id); };
  if (column == "half") return [](const LoggedOpportunity& o) { return fmt::format("half {}", o.half); };
  if (column == "table") return [=](const LoggedOpportunity& o) { return session(o).table; };
  if (column == "arm") return [=](const LoggedOpportunity& o) { return session(o).arm; };
  if (column == "scenario") return [=](const LoggedOpportunity& o) { return session(o).scenario; };
  const auto bin = [](const std::optional<double>& distance_m) {
    return distance_m ? distance_bins()[distance_bin(std::abs(*distance_m))] : std::string();
  };
  if (column == "distance") return [=](const LoggedOpportunity& o) { return bin(o.distance_m); };
  if (column == "start_distance") return [=](const LoggedOpportunity& o) { return bin(o.start_distance_m); };
  return std::nullopt;
}

// Older and simpler ones first, others behind by their name.
std::size_t rank_of(const std::string& name) {
  static constexpr std::array kOrder{"stopped", "moving", "predictive", "learned", "oracle", "old", "new"};
  return static_cast<std::size_t>(std::ranges::find(kOrder, name) - kOrder.begin());
}

std::vector<std::string> groups_of(const LoggedOpportunities& logged, const std::string& by, const Name& name) {
  std::vector<std::string> groups;
  std::set<std::string> seen;
  for (const LoggedOpportunity& o : logged.rows) {
    const std::string group = name(o);
    if (!group.empty() && seen.insert(group).second) groups.push_back(group);
  }
  if (by != "arm") std::ranges::sort(groups, {}, [](const auto& group) { return std::pair(rank_of(group), group); });
  return groups;
}

bool was_drawn(const LoggedOpportunity& o) { return o.probability && *o.probability < 1.0; }

// Groups of a match by the halves that they played.
using Halves = std::map<std::uint32_t, std::map<int, std::set<std::uint32_t>>>;

void infer_design(KickBook& book, const LoggedOpportunities& logged, const std::string& by,
                  const std::vector<std::optional<std::uint32_t>>& group_of, bool drawn) {
  std::map<std::pair<std::uint32_t, std::uint64_t>, std::uint32_t> first_group;
  bool shared = false, all_numbered = true;
  Halves halves;
  std::vector<std::set<double>> chances(book.groups.size());
  for (const ComparedSession& session : logged.sessions)
    all_numbered = all_numbered && session.match_id && session.simulated;
  for (std::size_t i = 0; i < logged.rows.size(); ++i) {
    if (!group_of[i]) continue;
    const LoggedOpportunity& o = logged.rows[i];
    const std::uint32_t match = logged.sessions[o.session].match;
    if (o.probability) chances[*group_of[i]].insert(*o.probability);
    halves[match][o.half].insert(*group_of[i]);
    if (!all_numbered || shared || o.possession_id == 0) continue;
    const std::uint64_t id = static_cast<std::uint64_t>(o.half) << 48 | static_cast<std::uint64_t>(o.possession_id);
    const auto [place, added] = first_group.try_emplace({match, id}, *group_of[i]);
    shared = !added && place->second != *group_of[i];
  }
  if (shared && !drawn) {
    book.design = Design::kPaired;
    book.design_reason = "the sessions have the same matches by number";
    return;
  }
  if (drawn) {
    book.design = Design::kRandomised;
    book.design_reason = "the log has the probability with which each possession's policy was drawn";
    std::vector<double> shares;
    double sum = 0.0;
    for (const auto& chance : chances) {
      if (chance.size() == 1) shares.push_back(*chance.begin());
      sum += chance.size() == 1 ? *chance.begin() : 0.0;
    }
    if (shares.size() == book.groups.size() && std::abs(sum - 1.0) < 1e-6) book.planned_shares = shares;
    return;
  }
  std::set<std::uint32_t> first, second;  // groups that had a first half alone, a second one
  std::size_t mixed = 0;
  for (const auto& [match, by_half] : halves) {
    if (by_half.size() < 2 || by_half.begin()->second == by_half.rbegin()->second) continue;
    ++mixed;
    first.insert(by_half.begin()->second.begin(), by_half.begin()->second.end());
    second.insert(by_half.rbegin()->second.begin(), by_half.rbegin()->second.end());
  }
  if (mixed > 0 && first == second) {
    book.design = Design::kAlternating;
    book.design_reason = "both halves were played with each";
  } else if (mixed > 0) {
    book.design_reason = "one after the other in every match, always in the same order of halves";
  } else if (by == "robot") {
    book.design_reason = "robots play side by side but from other places";
  } else {
    book.design_reason = "in different matches";
  }
}

void add_minutes(KickBook& book, const LoggedOpportunities& logged, const std::string& by) {
  for (const LoggedHalf& half : logged.halves) {
    const ComparedSession& session = logged.sessions[half.session];
    const std::string name = by == "arm"      ? session.arm
                             : by == "table"  ? session.table
                             : by == "policy" ? half.policy
                                              : std::string();
    const auto group = std::ranges::find(book.groups, name);
    if (group == book.groups.end()) continue;
    book.minutes[{static_cast<std::uint32_t>(group - book.groups.begin()), session.match}] += half.minutes;
  }
}

}  // namespace

KickBook read_log_kicks(const std::vector<std::filesystem::path>& logs, const LogKicks& options, std::string& by) {
  const LoggedOpportunities logged = read_opportunities(logs, options.truth);
  std::set<std::string> arms;
  for (const ComparedSession& session : logged.sessions) arms.insert(session.arm);
  by = !options.by.empty() ? options.by : arms.size() > 1 ? "arm" : "policy";
  const std::array kBy{"policy", "table", "robot", "arm"};
  if (std::ranges::find(kBy, by) == kBy.end()) {
    throw std::runtime_error(fmt::format("--by '{}': a match log is compared by policy, table, robot or arm", by));
  }
  const auto group_name = *name_by(logged, by);
  const auto stratum_name = name_by(logged, options.stratify);
  if (!options.stratify.empty() && !stratum_name) {
    throw std::runtime_error(
        fmt::format("--stratify '{}': a match log has distance, start_distance, robot, half, "
                    "scenario, table, policy and arm",
                    options.stratify));
  }
  KickBook book;
  book.groups = groups_of(logged, by, group_name);
  book.outcome = options.truth ? "truth" : "observed";
  book.remarks = logged.remarks;
  book.matches = logged.matches;
  book.has_matches = true;
  for (const ComparedSession& session : logged.sessions) book.simulated = book.simulated || session.simulated;
  if (options.truth && !book.simulated)
    throw std::runtime_error("--outcome truth: none of these matches was simulated");
  book.has_opportunities = !logged.rows.empty() && std::ranges::all_of(logged.rows, &LoggedOpportunity::has_possession);
  book.stratified_by = options.stratify;
  book.strata_of_kicks = options.stratify == "distance";
  if (options.stratify.ends_with("distance")) book.strata = distance_bins();
  std::vector<std::optional<std::uint32_t>> group_of(logged.rows.size());
  std::map<std::string, std::uint32_t> places;
  for (std::uint32_t i = 0; i < book.groups.size(); ++i) places[book.groups[i]] = i;
  // Policies drawn for each possession are compared by those alone: chance gave no others their policy.
  const bool drawn = by == "policy" && std::ranges::any_of(logged.rows, was_drawn);
  std::int64_t nameless = 0, certain = 0;
  for (std::size_t i = 0; i < logged.rows.size(); ++i) {
    const LoggedOpportunity& o = logged.rows[i];
    const auto group = places.find(group_name(o));
    if (group == places.end()) {
      ++nameless;
      continue;
    }
    if (drawn && !was_drawn(o)) {
      ++certain;
      continue;
    }
    group_of[i] = group->second;
    Opportunity opportunity;
    opportunity.group = group->second;
    opportunity.match = logged.sessions[o.session].match;
    if (o.has_possession && o.possession_id != 0) {
      opportunity.id = static_cast<std::uint64_t>(o.half) << 48 | static_cast<std::uint64_t>(o.possession_id);
    }
    const std::string stratum = stratum_name ? (*stratum_name)(o) : std::string();
    opportunity.stratum = stratum.empty() ? UINT32_MAX : place_of(book.strata, stratum);
    opportunity.ending = o.ending;
    book.opportunities.push_back(opportunity);
  }
  const auto unknown = static_cast<std::uint32_t>(book.strata.size());
  for (Opportunity& opportunity : book.opportunities) opportunity.stratum = std::min(opportunity.stratum, unknown);
  if (nameless > 0) {
    book.remarks.push_back(
        fmt::format("{} {} without a {} left out", nameless, book.has_opportunities ? "opportunities" : "kicks", by));
  }
  if (certain > 0) {
    book.remarks.push_back(fmt::format("{} opportunities left out: their policy was not drawn at random", certain));
  }
  infer_design(book, logged, by, group_of, drawn);
  add_minutes(book, logged, by);
  return book;
}

}  // namespace trivela::evaluator
