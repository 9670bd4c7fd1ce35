#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/options/number_checks.hpp"
#include "cli/options/output.hpp"
#include "cli/team/valid_team.hpp"
#include "cli/verbs.hpp"
#include "config/settings.hpp"
#include "config/text/installation.hpp"
#include "evaluator/sessions/log_findings.hpp"
#include "monitor/network/findings.hpp"
#include "monitor/network/gather.hpp"
#include "nodes/runtime/node_main.hpp"

namespace trivela::cli {
namespace {

namespace network = monitor::network;

struct DoctorFlags {
  std::vector<std::string> logs;
  std::string config = config::shipped("default.toml").string();
  std::optional<std::uint32_t> domain;
  std::string interface;
  std::vector<std::string> peers;
  std::string team;
  bool network = false;
  bool team_without_keys = false;
  bool json = false;
};

const char* verdict_text(network::Verdict verdict) {
  constexpr std::array kTexts{"ok", "warn", "BAD"};
  return kTexts.at(static_cast<std::size_t>(verdict));
}

void say_findings(const std::vector<network::Finding>& findings) {
  for (const network::Finding& finding : findings) {
    say(fmt::format("{:<5}{:<16} {}\n", verdict_text(finding.verdict), finding.check, finding.value));
    if (!finding.advice.empty()) say(fmt::format("     {:<16} -> {}\n", "", finding.advice));
  }
}

nlohmann::ordered_json json_of(const std::vector<network::Finding>& findings) {
  auto all = nlohmann::ordered_json::array();
  for (const network::Finding& finding : findings) {
    std::string verdict = verdict_text(finding.verdict);
    if (finding.verdict == network::Verdict::kBad) verdict = "bad";
    all.push_back(
        {{"check", finding.check}, {"verdict", verdict}, {"value", finding.value}, {"advice", finding.advice}});
  }
  return all;
}

void say_json(const nlohmann::ordered_json& json) {
  say(json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

/// The team's machines are peers, its interface and the domain between the machines what is looked at.
DoctorFlags with_team(DoctorFlags flags) {
  if (flags.team.empty()) return flags;
  const config::Team team = valid_team(flags.team);
  if (flags.interface.empty()) flags.interface = team.team.interface;
  if (!flags.domain) flags.domain = team.domains.team;
  for (const config::TeamRobot& robot : team.robots) flags.peers.push_back(robot.address);
  flags.peers.push_back(team.base.address);
  flags.team_without_keys = team.team.keys.empty();
  return flags;
}

/// A log's finding as the network's are said.
network::Finding finding_of(const evaluator::LogFinding& found) {
  using evaluator::Health;
  const network::Verdict verdict = found.health == Health::kOk    ? network::Verdict::kOk
                                   : found.health == Health::kBad ? network::Verdict::kBad
                                                                  : network::Verdict::kWarn;
  return {found.check, verdict, found.value, found.advice};
}

/// Logs whose findings are worst decide: one that cannot be read or was changed, one that misses something.
int examine_logs(const DoctorFlags& flags) {
  evaluator::Health worst = evaluator::Health::kOk;
  auto all = nlohmann::ordered_json::array();
  const auto tell = [&](const std::string& of, const std::vector<evaluator::LogFinding>& found) {
    std::vector<network::Finding> findings;
    for (const evaluator::LogFinding& one : found) {
      worst = std::max(worst, one.health);
      findings.push_back(finding_of(one));
    }
    if (flags.json) {
      all.push_back({{"log", of}, {"findings", json_of(findings)}});
    } else {
      say(of + '\n');
      say_findings(findings);
    }
  };
  for (const std::string& log : flags.logs) tell(log, evaluator::examine_log(log));
  if (flags.logs.size() > 1) tell("all of them", evaluator::compare_logs({flags.logs.begin(), flags.logs.end()}));
  if (flags.json) say_json(all);
  return worst == evaluator::Health::kBad ? kFailed : worst == evaluator::Health::kDoubtful ? kDoneWithLoss : kDone;
}

int examine(const DoctorFlags& flags) {
  config::Settings settings = config::load_settings(flags.config);
  if (flags.domain) settings.domain.domain_id = *flags.domain;
  auto findings =
      network::findings_of(network::gather({nodes::domain_of(settings.domain), flags.interface, flags.peers}));
  if (flags.team_without_keys)
    findings.push_back({"keys", network::Verdict::kWarn,
                        "the team plays without: any program on its networks can stop "
                        "the robots, order kicks and fire coils",
                        "trivela keys issue makes them, team.keys names their folder (docs/security.md)"});
  flags.json ? say_json(json_of(findings)) : say_findings(findings);
  const bool bad = std::ranges::any_of(
      findings, [](const network::Finding& finding) { return finding.verdict == network::Verdict::kBad; });
  return bad ? kFailed : kDone;
}

int run_doctor(const DoctorFlags& flags) {
  if (flags.logs.empty() && !flags.network) throw UsageError{"say which: match logs, or --network"};
  return flags.logs.empty() ? examine(with_team(flags)) : examine_logs(flags);
}

}  // namespace

void add_doctor(CLI::App& app, int& exit_code) {
  const auto [verb, flags] = add_verb(
      app, exit_code, "doctor", "Say what is wrong with logs or this machine's network, and what to do", run_doctor);
  verb->footer(
      R"(Of logs: their rows against their digests, sessions that were never closed, gaps, a -wal left behind, a match
that was cut short, the goal line against the tracks of balls, clocks that jumped, and of several kicks of
which they say different things. Nothing is changed. Exit codes: 0 nothing is wrong; 1 a log cannot be read or is
not what was recorded; 3 something is missing or doubtful.
Of the network: 0 nothing is bad, warnings may stand; 1 something is. The firewall's rules are read where nft is
installed and permits it, as root.)");
  auto* const logs = verb->add_option("logs", flags->logs, "match logs");
  verb->add_flag("--network", flags->network, "interface, multicast, buffers, clock, ports, peers, firewall")
      ->excludes(logs);
  add_default(*verb, "--config", flags->config, "whose [domain] is looked at", readable_file());
  verb->add_option("--domain", flags->domain, "DDS domain instead of the configuration's")->check(CLI::Range(0, 100));
  verb->add_option("--interface", flags->interface,
                   "name or address; default: what the DDS configuration names, else the first that is up");
  verb->add_option("--peers", flags->peers, "names or addresses of machines that should be there");
  verb->add_option("--team", flags->team,
                   "a team's file: its machines are peers, its interface and domain are looked at")
      ->check(readable_file());
  verb->add_flag("--json", flags->json, "findings as JSON");
}

}  // namespace trivela::cli
