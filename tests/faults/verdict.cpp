#include "tests/faults/verdict.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "kicking/geometry/time.hpp"

namespace trivela::faults {
namespace {

constexpr std::array kKinds{FaultKind::kKill,    FaultKind::kStop,  FaultKind::kRestart, FaultKind::kTwin,
                            FaultKind::kSilence, FaultKind::kDelay, FaultKind::kCut,     FaultKind::kGarble};

constexpr std::size_t kMostTold = 20;  // findings in the text

std::size_t count_of(const std::vector<Finding>& findings, std::initializer_list<Offence> offences) {
  return static_cast<std::size_t>(std::count_if(findings.begin(), findings.end(), [&](const Finding& finding) {
    return std::find(offences.begin(), offences.end(), finding.offence) != offences.end();
  }));
}

std::size_t without_order(const Verdict& verdict) {
  return count_of(verdict.findings,
                  {Offence::kNoOrder, Offence::kUnauthorised, Offence::kStale, Offence::kTwice, Offence::kCarriedLate});
}
std::size_t while_stopped(const Verdict& verdict) {
  return count_of(verdict.findings, {Offence::kStopped, Offence::kSilent});
}
std::size_t too_soon(const Verdict& verdict) { return count_of(verdict.findings, {Offence::kTooSoon}); }

std::size_t unrecovered(const Verdict& verdict) {
  return static_cast<std::size_t>(
      std::count_if(verdict.trials.begin(), verdict.trials.end(), [](const Trial& trial) { return !trial.recovered; }));
}

bool forges(const Trial& trial) { return trial.fault.kind == FaultKind::kGarble; }

/// Recovered from, but later than it may take.
bool slow(const Trial& trial) { return trial.recovered && trial.streams_s > time_for_streams_s(trial.fault); }

std::size_t slow_trials(const Verdict& verdict, bool forged) {
  return static_cast<std::size_t>(
      std::count_if(verdict.trials.begin(), verdict.trials.end(),
                    [forged](const Trial& trial) { return forges(trial) == forged && slow(trial); }));
}

bool hits(const Fault& fault, std::size_t node) { return fault.node == node || fault.other == node; }

/// Row of a node: how many faults of each kind, and how long it took to be whole.
struct NodeRow {
  std::array<std::size_t, kKinds.size()> faults{};
  std::size_t unrecovered = 0;
  std::vector<double> streams_s;
  std::vector<double> kick_s;
};

NodeRow row_of(const Verdict& verdict, std::size_t node) {
  NodeRow row;
  for (const Trial& trial : verdict.trials) {
    if (!hits(trial.fault, node)) continue;
    ++row.faults[static_cast<std::size_t>(trial.fault.kind)];
    if (!trial.recovered) {
      ++row.unrecovered;
      continue;
    }
    row.streams_s.push_back(trial.streams_s);
    row.kick_s.push_back(trial.kick_s);
  }
  return row;
}

/// What was going on when somebody fired.
std::string circumstances(const Verdict& verdict, std::int64_t at_ns) {
  const auto after = std::find_if(verdict.trials.rbegin(), verdict.trials.rend(),
                                  [&](const Trial& trial) { return trial.began_ns <= at_ns; });
  if (after == verdict.trials.rend()) return "before any fault";
  return fmt::format("{:.3f} s after the start of \"{}\"", kicking::seconds(at_ns - after->began_ns),
                     text(after->fault));
}

}  // namespace

bool Verdict::clean() const {
  return findings.empty() && logged.lost.empty() && unreadable.empty() &&
         std::all_of(trials.begin(), trials.end(), [](const Trial& trial) {
           return trial.recovered && !slow(trial) && trial.complaint.empty() && trial.crashed.empty();
         });
}

double time_for_streams_s(const Fault& fault) { return fault.kind == FaultKind::kGarble ? 4.0 : 2.0; }

Times times_of(std::vector<double> values_s) {
  if (values_s.empty()) return {std::nan(""), std::nan("")};
  std::sort(values_s.begin(), values_s.end());
  return {values_s[(values_s.size() - 1) / 2], values_s.back()};
}

namespace {

/// How often each node was hit, and how long it took to recover.
std::string lines_by_node(const Verdict& verdict) {
  std::string out = "Faults by node (a link counts at both ends) and seconds until whole: topics back, next kick\n";
  out += fmt::format("  {:<14}", "node");
  for (const FaultKind kind : kKinds) out += fmt::format("{:>8}", name(kind));
  out += fmt::format("{:>9}{:>8}{:>8}{:>8}{:>8}\n", "not whole", "median", "worst", "median", "worst");
  for (std::size_t node = 0; node < kNodes.size(); ++node) {
    const NodeRow row = row_of(verdict, node);
    out += fmt::format("  {:<14}", kNodes[node]);
    for (const std::size_t faults : row.faults) out += fmt::format("{:>8}", faults);
    const Times streams = times_of(row.streams_s), kick = times_of(row.kick_s);
    out += fmt::format("{:>9}{:>8.2f}{:>8.2f}{:>8.2f}{:>8.2f}\n", row.unrecovered, streams.median_s, streams.worst_s,
                       kick.median_s, kick.worst_s);
  }
  return out;
}

/// What the wire did, and the counts that must be 0.
std::string counts_text(const Verdict& verdict) {
  std::string out =
      fmt::format("\nFrames on the links: {} forwarded, {} delayed, {} dropped, {} garbled\n", verdict.frames.forwarded,
                  verdict.frames.delayed, verdict.frames.dropped, verdict.frames.garbled);
  out += fmt::format("Fires for an order that the garbled wire had given another id, which nobody can tell: {}\n",
                     verdict.forged.size());
  std::size_t crashed = 0;
  for (const Trial& trial : verdict.trials) crashed += trial.crashed.size();
  out += fmt::format("Nodes that ended by a signal while packets were garbled, and were started again: {}\n", crashed);
  out += fmt::format("Kicks: {} in a log, {} in a gap that the logs count\n", verdict.logged.in_a_log,
                     verdict.logged.counted);
  out += "\n  goal 0                                       count\n";
  out += fmt::format("  fires without a valid fresh order           {:>6}\n", without_order(verdict));
  out += fmt::format("  fires while stopped                         {:>6}\n", while_stopped(verdict));
  out += fmt::format("  fires closer than the minimum interval      {:>6}\n", too_soon(verdict));
  out += fmt::format("  kicks neither in a log nor in a counted gap {:>6}\n", verdict.logged.lost.size());
  out += fmt::format("  faults that were not recovered from         {:>6}\n", unrecovered(verdict));
  out += fmt::format("  topics back later than 2 s after a fault   {:>6}\n", slow_trials(verdict, false));
  out += fmt::format("  ... later than 4 s after forged packets     {:>6}\n", slow_trials(verdict, true));
  return out;
}

/// Each thing that was not in order.
std::string findings_text(const Verdict& verdict) {
  std::string out;
  const std::size_t told = std::min(verdict.findings.size(), kMostTold);
  for (std::size_t i = 0; i < told; ++i) {
    const Finding& finding = verdict.findings[i];
    out += fmt::format("  kick {} {}: {}; {}\n", finding.fire.kick_id, name(finding.offence), finding.why,
                       circumstances(verdict, finding.fire.arrival_ns));
  }
  if (told < verdict.findings.size())
    out += fmt::format("  ... and {} more (--json has all)\n", verdict.findings.size() - told);
  for (const Trial& trial : verdict.trials)
    if (slow(trial))
      out += fmt::format("  \"{}\": topics back after {:.2f} s alone\n", text(trial.fault), trial.streams_s);
  for (const FireSeen& fire : verdict.logged.lost)
    out += fmt::format("  kick {} is in no log; {}\n", fire.kick_id, circumstances(verdict, fire.arrival_ns));
  for (const std::string& log : verdict.unreadable) out += fmt::format("  {}\n", log);
  for (const Trial& trial : verdict.trials) {
    if (!trial.complaint.empty()) out += fmt::format("  \"{}\": {}\n", text(trial.fault), trial.complaint);
    for (const std::string& crash : trial.crashed) out += fmt::format("  \"{}\": {}\n", text(trial.fault), crash);
  }
  return out;
}

}  // namespace

std::string text(const Verdict& verdict) {
  return fmt::format("{} faults with seed {} in {:.0f} s: {} orders, {} fires\n\n", verdict.trials.size(), verdict.seed,
                     verdict.took_s, verdict.orders, verdict.fires.size()) +
         lines_by_node(verdict) + counts_text(verdict) + findings_text(verdict);
}

nlohmann::json json(const Verdict& verdict) {
  nlohmann::json out{{"faults", verdict.trials.size()},
                     {"seed", verdict.seed},
                     {"took_s", verdict.took_s},
                     {"orders", verdict.orders},
                     {"fires", verdict.fires.size()},
                     {"fires_for_forged_ids", verdict.forged.size()},
                     {"kicks_in_a_log", verdict.logged.in_a_log},
                     {"kicks_in_a_counted_gap", verdict.logged.counted},
                     {"fires_without_a_valid_fresh_order", without_order(verdict)},
                     {"fires_while_stopped", while_stopped(verdict)},
                     {"fires_too_soon", too_soon(verdict)},
                     {"kicks_lost", verdict.logged.lost.size()},
                     {"not_recovered", unrecovered(verdict)},
                     {"streams_slower_than_2_s", slow_trials(verdict, false)},
                     {"streams_slower_than_4_s_after_forged_packets", slow_trials(verdict, true)},
                     {"clean", verdict.clean()}};
  for (std::size_t node = 0; node < kNodes.size(); ++node) {
    const NodeRow row = row_of(verdict, node);
    const Times streams = times_of(row.streams_s), kick = times_of(row.kick_s);
    nlohmann::json& entry = out["nodes"][std::string{kNodes[node]}];
    for (const FaultKind kind : kKinds) entry["faults"][name(kind)] = row.faults[static_cast<std::size_t>(kind)];
    entry["streams_s"] = {{"median", streams.median_s}, {"worst", streams.worst_s}};
    entry["kick_s"] = {{"median", kick.median_s}, {"worst", kick.worst_s}};
  }
  for (const Trial& trial : verdict.trials)
    out["trials"].push_back({{"fault", text(trial.fault)},
                             {"recovered", trial.recovered},
                             {"streams_s", trial.streams_s},
                             {"kick_s", trial.kick_s},
                             {"complaint", trial.complaint},
                             {"crashed", trial.crashed}});
  for (const Finding& finding : verdict.findings)
    out["findings"].push_back({{"kick_id", finding.fire.kick_id},
                               {"offence", name(finding.offence)},
                               {"why", finding.why},
                               {"when", circumstances(verdict, finding.fire.arrival_ns)}});
  return out;
}

}  // namespace trivela::faults
