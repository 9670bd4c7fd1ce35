#include <fmt/core.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/open_file.hpp"
#include "cli/output.hpp"
#include "cli/sound_team.hpp"
#include "cli/verbs.hpp"
#include "config/installation.hpp"
#include "config/settings.hpp"
#include "monitor/network/findings.hpp"
#include "monitor/network/gather.hpp"
#include "nodes/runtime/node_main.hpp"

namespace trivela::cli {
namespace {

namespace network = monitor::network;

struct DoctorFlags {
  std::string config = config::shipped("default.toml").string();
  std::optional<std::uint32_t> domain;
  std::string interface;
  std::vector<std::string> peers;
  std::string team;
  bool network = false;
  bool json = false;
};

const char* verdict_text(network::Verdict verdict) {
  switch (verdict) {
    case network::Verdict::kOk:
      return "ok";
    case network::Verdict::kWarn:
      return "warn";
    case network::Verdict::kBad:
      return "BAD";
  }
  return "";
}

void say_findings(const std::vector<network::Finding>& findings) {
  for (const network::Finding& finding : findings) {
    say(fmt::format("{:<5}{:<16} {}\n", verdict_text(finding.verdict), finding.check, finding.value));
    if (!finding.advice.empty()) say(fmt::format("     {:<16} -> {}\n", "", finding.advice));
  }
}

void say_json(const std::vector<network::Finding>& findings) {
  auto all = nlohmann::ordered_json::array();
  for (const network::Finding& finding : findings) {
    std::string verdict = verdict_text(finding.verdict);
    if (finding.verdict == network::Verdict::kBad) verdict = "bad";
    all.push_back(
        {{"check", finding.check}, {"verdict", verdict}, {"value", finding.value}, {"advice", finding.advice}});
  }
  say(all.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

/// The team's machines are peers, its interface and the domain between the machines what is looked at.
DoctorFlags with_team(DoctorFlags flags) {
  if (flags.team.empty()) return flags;
  const config::Team team = sound_team(flags.team);
  if (flags.interface.empty()) flags.interface = team.team.interface;
  if (!flags.domain) flags.domain = team.domains.team;
  for (const config::TeamRobot& robot : team.robots) flags.peers.push_back(robot.address);
  flags.peers.push_back(team.base.address);
  return flags;
}

int examine(const DoctorFlags& flags) {
  config::Settings settings = config::load_settings(flags.config);
  if (flags.domain) settings.domain.domain_id = *flags.domain;
  const auto findings =
      network::findings_of(network::gather({nodes::domain_of(settings.domain), flags.interface, flags.peers}));
  flags.json ? say_json(findings) : say_findings(findings);
  const bool bad = std::ranges::any_of(
      findings, [](const network::Finding& finding) { return finding.verdict == network::Verdict::kBad; });
  return bad ? kFailed : kDone;
}

}  // namespace

void add_doctor(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("doctor", "Say what is wrong with this machine's network, and what to do about it");
  auto flags = std::make_shared<DoctorFlags>();
  verb->footer(
      "Exit codes: 0 nothing is bad, warnings may stand; 1 something is; 2 bad usage. The firewall's rules are read\n"
      "where nft is installed and permits it, as root.");
  verb->add_flag("--network", flags->network, "interface, multicast, buffers, clock, ports, peers, firewall")
      ->required();
  verb->add_option("--config", flags->config, "whose [domain] is looked at")
      ->check(readable_file())
      ->capture_default_str();
  verb->add_option("--domain", flags->domain, "DDS domain instead of the configuration's")->check(CLI::Range(0, 100));
  verb->add_option("--interface", flags->interface,
                   "name or address; default: what the DDS configuration names, else the first that is up");
  verb->add_option("--peers", flags->peers, "names or addresses of machines that should be there");
  verb->add_option("--team", flags->team,
                   "a team's file: its machines are peers, its interface and domain are looked at")
      ->check(readable_file());
  verb->add_flag("--json", flags->json, "findings as JSON");
  verb->callback([flags, &exit_code] { exit_code = examine(with_team(*flags)); });
}

}  // namespace trivela::cli
