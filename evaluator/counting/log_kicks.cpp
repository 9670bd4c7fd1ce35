#include "evaluator/counting/log_kicks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <tuple>

#include "evaluator/counting/log_design.hpp"
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
