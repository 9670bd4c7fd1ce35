#include "evaluator/report/log_design.hpp"

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
bool share_opportunities(const KickBook& book) {
  std::map<Situation, std::uint32_t> first_group;
  for (const Opportunity& o : book.opportunities) {
    if (o.id != 0 && first_group.try_emplace(situation_of(o), o.group).first->second != o.group) return true;
  }
  return false;
}

void infer_drawn(KickBook& book, const LoggedOpportunities& logged, const std::vector<std::size_t>& rows) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::set<double>> chances;  // by group and stratum
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Opportunity& o = book.opportunities[i];
    chances[{o.group, o.stratum}].insert(*logged.rows[rows[i]].probability);
  }
  if (std::ranges::any_of(chances, [](const auto& chance) { return chance.second.size() > 1; })) {
    book.design_reason = fmt::format(
        "drawn at random, but not everywhere with the same probability: together, {} also differ in where they were "
        "drawn; compare within it (--stratify arm), or weigh with trivela evaluate-policy",
        fmt::join(book.groups, " and "));
    return;
  }
  book.design = Design::kRandomised;
  book.design_reason = "the log has the probability with which each possession's policy was drawn";
  if (chances.size() != book.groups.size()) return;
  std::vector<double> shares;
  double sum = 0.0;
  for (const auto& [group, chance] : chances) {
    shares.push_back(*chance.begin());
    sum += shares.back();
  }
  if (std::abs(sum - 1.0) < 1e-6) book.planned_shares = shares;
}

void infer_from_halves(KickBook& book, const LoggedOpportunities& logged, const std::vector<std::size_t>& rows,
                       const std::string& by) {
  std::map<std::uint32_t, std::map<int, std::set<std::uint32_t>>> halves;  // groups by match and half
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Opportunity& o = book.opportunities[i];
    halves[o.match][logged.rows[rows[i]].half].insert(o.group);
  }
  std::set<std::uint32_t> first, second;  // groups that had a first half alone, a second one
  for (const auto& [match, by_half] : halves) {
    if (by_half.size() < 2 || by_half.begin()->second == by_half.rbegin()->second) continue;
    first.insert(by_half.begin()->second.begin(), by_half.begin()->second.end());
    second.insert(by_half.rbegin()->second.begin(), by_half.rbegin()->second.end());
  }
  if (!first.empty() && first == second) {
    book.design = Design::kAlternating;
    book.design_reason = "both halves were played with each";
  } else if (!first.empty()) {
    book.design_reason = "one after the other in every match, always in the same order of halves";
  } else if (by == "robot") {
    book.design_reason = "robots play side by side but from other places";
  } else {
    book.design_reason = "in different matches, or with different settings";
  }
}

}  // namespace

void infer_design(KickBook& book, const LoggedOpportunities& logged, const std::vector<std::size_t>& rows,
                  const std::string& by, bool drawn) {
  if (drawn) return infer_drawn(book, logged, rows);
  const bool numbered = std::ranges::all_of(
      logged.sessions, [](const ComparedSession& session) { return session.match_id && session.simulated; });
  if (!numbered || !share_opportunities(book)) return infer_from_halves(book, logged, rows, by);
  book.design = Design::kPaired;
  book.design_reason = "the sessions have the same matches by number";
}

void keep_common_settings(KickBook& book, const std::string& by) {
  std::map<std::uint32_t, std::set<std::uint32_t>> groups_of;  // by setting
  std::set<std::pair<std::uint32_t, Situation>> seen;
  for (const Opportunity& o : book.opportunities) {
    groups_of[o.setting].insert(o.group);
    if (o.id == 0 || seen.insert({o.group, situation_of(o)}).second) continue;
    throw std::runtime_error(fmt::format(
        "{0} '{1}' was played twice on the same opportunities, in sessions that differ: {2}, or leave a log "
        "out",
        by, book.groups[o.group], by == "arm" ? "give each its own arm" : "compare by arm"));
  }
  const auto common = [&](std::uint32_t setting) { return groups_of[setting].size() == book.groups.size(); };
  if (std::ranges::none_of(groups_of, [&](const auto& of) { return common(of.first); })) {
    throw std::runtime_error(
        fmt::format("no {} was played with each {} ({}): what differs between them is not the {} alone; compare by arm",
                    by == "table" ? "policy with the same settings" : "table with the same settings", by,
                    fmt::join(book.groups, ", "), by));
  }
  std::vector<std::int64_t> left_out(book.groups.size());
  std::erase_if(book.opportunities, [&](const Opportunity& o) {
    left_out[o.group] += common(o.setting) ? 0 : 1;
    return !common(o.setting);
  });
  for (std::size_t i = 0; i < left_out.size(); ++i) {
    if (left_out[i] == 0) continue;
    book.remarks.push_back(
        fmt::format("{} opportunities of '{}' left out: their {} or settings were not played with every {}",
                    left_out[i], book.groups[i], by == "table" ? "policy" : "table", by));
  }
}

}  // namespace trivela::evaluator
