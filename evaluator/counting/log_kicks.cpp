#include "evaluator/counting/log_kicks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "evaluator/counting/policy_order.hpp"

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
  if (column == "log") return [&, session](const LoggedOpportunity& o) { return logged.logs[session(o).log]; };
  if (column == "scenario") return [=](const LoggedOpportunity& o) { return session(o).scenario; };
  const auto bin = [](const std::optional<double>& distance_m) {
    return distance_m ? distance_bins()[distance_bin(std::abs(*distance_m))] : std::string();
  };
  if (column == "distance") return [=](const LoggedOpportunity& o) { return bin(o.distance_m); };
  if (column == "start_distance") return [=](const LoggedOpportunity& o) { return bin(o.start_distance_m); };
  return std::nullopt;
}

std::vector<std::string> groups_of(const LoggedOpportunities& logged, const std::string& by, const Name& name) {
  std::vector<std::string> groups;
  std::set<std::string> seen;
  for (const LoggedOpportunity& o : logged.rows) {
    const std::string group = name(o);
    if (!group.empty() && seen.insert(group).second) groups.push_back(group);
  }
  if (by != "arm" && by != "log") std::ranges::sort(groups, PolicyOrder{});
  return groups;
}

bool was_drawn(const LoggedOpportunity& o) { return o.probability && *o.probability < 1.0; }

// Numbers of what sessions and policies were played with apart from what is compared.
class Settings {
 public:
  explicit Settings(const std::string& by) : by_(by) {}

  std::uint32_t of(const ComparedSession& session, const std::string& policy) {
    const std::int64_t calibration = session.calibration_id.value_or(0);
    const bool any = by_ == "arm" || by_ == "robot" || by_ == "log";
    const Setting setting{by_ == "policy" || any ? "" : policy, by_ == "table" || any ? "" : session.table,
                          any ? 0 : session.setup.settings, calibration};
    return numbers_.try_emplace(setting, static_cast<std::uint32_t>(numbers_.size())).first->second;
  }

 private:
  using Setting = std::tuple<std::string, std::string, std::uint32_t, std::int64_t>;
  std::string by_;
  std::map<Setting, std::uint32_t> numbers_;
};

// Minutes of play of the possessions that a group had; the whole session's, where that is what is compared.
void add_minutes(KickDataset& dataset, const LoggedOpportunities& logged, const std::string& by, Settings& settings) {
  std::set<std::uint32_t> kept;  // settings
  for (const Opportunity& o : dataset.opportunities) kept.insert(o.setting);
  const auto left_out = [&](std::uint32_t setting) {
    return dataset.design == Design::kPaired && !kept.contains(setting);
  };
  for (const PlayedSpan& span : logged.spans) {
    const ComparedSession& session = logged.sessions[span.session];
    std::set<std::string> names;
    const auto name_of_session = [&]() -> std::optional<std::string> {
      if (by == "arm") return session.arm;
      if (by == "table") return session.table;
      if (by == "log") return logged.logs[session.log];
      return std::nullopt;
    };
    const auto of_session = name_of_session();
    if (of_session && span.had_it.empty()) names.insert(*of_session);
    for (const PolicyOfRobot& who : span.had_it) {
      if (left_out(settings.of(session, who.policy))) continue;
      names.insert(of_session ? *of_session : by == "policy" ? who.policy : fmt::format("robot {}", who.robot_id));
    }
    for (const std::string& name : names) {
      const auto group = std::ranges::find(dataset.groups, name);
      if (group == dataset.groups.end()) continue;
      dataset.minutes[{static_cast<std::uint32_t>(group - dataset.groups.begin()), session.match}] += span.minutes;
    }
  }
}

void check(const LogKicks& options, const std::string& by, bool known_stratum) {
  const std::array kBy{"policy", "table", "robot", "arm", "log"};
  if (std::ranges::find(kBy, by) == kBy.end()) {
    throw BadOption(fmt::format("by '{}': a match log is compared by policy, table, robot, arm or log", by));
  }
  if (!options.stratify.empty() && !known_stratum) {
    throw BadOption(fmt::format(
        "stratify '{}': a match log has distance, start_distance, robot, half, scenario, table, policy, arm and log",
        options.stratify));
  }
}

// The dataset without its opportunities: what is compared, and how. Throws where the logs do not say what is asked for.
KickDataset dataset_of(const LoggedOpportunities& logged, const LogKicks& options, const std::string& by) {
  KickDataset dataset;
  dataset.groups = groups_of(logged, by, *name_by(logged, by));
  if (dataset.groups.empty() && !logged.rows.empty()) {
    throw BadOption(fmt::format("by {0}: no session of these logs names its {0}{1}", by,
                                by == "table" || by == "arm" ? "; those of trivela simulate do" : ""));
  }
  const bool labelled = !logged.rows.empty() && std::ranges::all_of(logged.rows, [&](const LoggedOpportunity& o) {
    return logged.sessions[o.session].imported;
  });
  dataset.outcome = options.truth ? "truth" : labelled ? "labelled" : "observed";
  dataset.remarks = logged.remarks;
  dataset.blocked_apart = options.blocked_apart;
  dataset.matches = logged.matches;
  dataset.has_matches = true;
  for (const ComparedSession& session : logged.sessions) dataset.simulated = dataset.simulated || session.simulated;
  if (options.truth && !dataset.simulated) throw BadOption("outcome truth: none of these matches was simulated");
  dataset.has_opportunities =
      !logged.rows.empty() && std::ranges::all_of(logged.rows, &LoggedOpportunity::has_possession);
  dataset.stratified_by = options.stratify;
  dataset.strata_of_kicks = options.stratify == "distance";
  if (options.stratify.ends_with("distance")) dataset.strata = distance_bins();
  return dataset;
}

// What a row says by itself, without the numbers that the dataset gives to groups, strata, settings and calibrations.
Opportunity opportunity_of(const LoggedOpportunity& o, const ComparedSession& session, const KickDataset& dataset) {
  Opportunity opportunity;
  opportunity.match = session.match;
  if (o.has_possession && o.possession_id != 0) {
    const std::uint64_t half = session.paired_halves ? 1 : static_cast<std::uint64_t>(o.half);
    opportunity.id = half << 48 | static_cast<std::uint64_t>(o.possession_id);
  }
  opportunity.ending = dataset.blocked_apart && o.blocked ? Ending::kBlocked : o.ending;
  if (opportunity.ending != Ending::kBlocked) opportunity.doubt = o.doubt;
  opportunity.said = o.said;
  opportunity.saved = dataset.outcome == "truth" ? o.said.truth_saved : o.said.saved;
  return opportunity;
}

// The opportunities of the dataset, and sentences on the rows left out. Returns which row each of them is.
std::vector<std::size_t> enter_opportunities(KickDataset& dataset, const LoggedOpportunities& logged,
                                             const std::string& by, bool drawn, Settings& settings) {
  const Name group_name = *name_by(logged, by);
  const auto stratum_name = name_by(logged, dataset.stratified_by);
  std::map<std::string, std::uint32_t> places;
  for (std::uint32_t i = 0; i < dataset.groups.size(); ++i) places[dataset.groups[i]] = i;
  std::map<std::optional<std::int64_t>, std::uint32_t> calibrations;  // numbers of calibrations
  std::vector<std::size_t> rows;
  std::int64_t nameless = 0, certain = 0;
  for (std::size_t i = 0; i < logged.rows.size(); ++i) {
    const LoggedOpportunity& o = logged.rows[i];
    const auto group = places.find(group_name(o));
    if (group == places.end()) {
      ++nameless;
    } else if (drawn && !was_drawn(o)) {
      ++certain;
    } else {
      const ComparedSession& session = logged.sessions[o.session];
      Opportunity& opportunity = dataset.opportunities.emplace_back(opportunity_of(o, session, dataset));
      opportunity.group = group->second;
      const std::string stratum = stratum_name ? (*stratum_name)(o) : std::string();
      opportunity.stratum = stratum.empty() ? UINT32_MAX : place_of(dataset.strata, stratum);
      opportunity.setting = settings.of(session, o.policy);
      opportunity.calibration = calibrations.try_emplace(session.calibration_id, calibrations.size()).first->second;
      dataset.keeper = dataset.keeper || o.said.by_people || opportunity.saved.value_or(false);
      rows.push_back(i);
    }
  }
  const auto unknown = static_cast<std::uint32_t>(dataset.strata.size());
  for (Opportunity& opportunity : dataset.opportunities) opportunity.stratum = std::min(opportunity.stratum, unknown);
  if (nameless > 0) {
    dataset.remarks.push_back(fmt::format("{} {} without a {} left out", nameless,
                                          dataset.has_opportunities ? "opportunities" : "kicks", by));
  }
  if (certain > 0)
    dataset.remarks.push_back(fmt::format("{} opportunities left out: their policy was not drawn at random", certain));
  return rows;
}

// Arms where there are several, else policies; logs where all have the same one.
std::string what_differs(const LoggedOpportunities& logged) {
  std::set<std::string> arms, policies;
  for (const ComparedSession& session : logged.sessions) arms.insert(session.arm);
  for (const LoggedOpportunity& o : logged.rows)
    if (!o.policy.empty()) policies.insert(o.policy);
  return arms.size() > 1 ? "arm" : policies.size() == 1 && logged.logs.size() > 1 ? "log" : "policy";
}

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

/// How the groups of a dataset came about, by what its logs say. `rows` are the places in logged.rows of the dataset's
/// opportunities; `drawn`: chance chose the group of each.
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

/// Of a paired dataset, where halves have the same possessions: of situations that a group had in several halves the
/// first. `rows` as for infer_design(), which stay in step.
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

/// Of a paired dataset the opportunities whose setting all groups played: what else differs is then the same for all.
/// Throws std::runtime_error where there is no such setting, or a group has an opportunity twice.
void keep_common_settings(KickDataset& dataset, const std::string& by) {
  std::map<std::uint32_t, std::set<std::uint32_t>> groups_by_setting;
  std::set<std::pair<std::uint32_t, Situation>> seen;
  for (const Opportunity& o : dataset.opportunities) {
    groups_by_setting[o.setting].insert(o.group);
    if (o.id == 0 || seen.insert({o.group, situation_of(o)}).second) continue;
    throw std::runtime_error(fmt::format(
        "{0} '{1}' was played twice on the same opportunities, in sessions that differ: {2}, or leave a log out", by,
        dataset.groups[o.group], by == "arm" ? "give each its own arm" : "compare by arm"));
  }
  const auto common = [&](std::uint32_t setting) { return groups_by_setting[setting].size() == dataset.groups.size(); };
  if (std::ranges::none_of(groups_by_setting, [&](const auto& of) { return common(of.first); })) {
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

}  // namespace

KickDataset kick_dataset_of(const LoggedOpportunities& logged, const LogKicks& options, std::string& by) {
  by = options.by.empty() ? what_differs(logged) : options.by;
  check(options, by, name_by(logged, options.stratify).has_value());
  KickDataset dataset = dataset_of(logged, options, by);
  Settings settings{by};
  // Policies drawn for each possession are compared by those alone: chance gave no others their policy.
  const bool drawn = by == "policy" && std::ranges::any_of(logged.rows, was_drawn);
  std::vector<std::size_t> rows = enter_opportunities(dataset, logged, by, drawn, settings);
  infer_design(dataset, logged, rows, by, drawn);
  if (dataset.design == Design::kPaired) {
    keep_first_of_paired_halves(dataset, logged, rows);
    keep_common_settings(dataset, by);
  }
  if (!drawn) add_minutes(dataset, logged, by, settings);
  return dataset;
}

}  // namespace trivela::evaluator
