#include <istream>
#include <regex>
#include <sstream>

#include "monitor/network/findings.hpp"

namespace trivela::monitor::network {
namespace {

bool has(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

// "7400", "7400-7649", "{ 53, 7400-7649 }" after "dport ": whether one of the numbers or ranges touches the ports; with
// `whole` whether one covers them all.
bool names_ports(const std::string& rule, Ports ports, bool whole) {
  static const std::regex kNamed{R"re(dport (\{[^}]*|\S*))re"}, kRange{R"re((\d+)(?:-(\d+))?)re"};
  std::smatch named;
  std::regex_search(rule, named, kNamed);
  for (std::sregex_iterator at{named[1].first, named[1].second, kRange}, end; at != end; ++at) {
    const unsigned long first = std::stoul((*at)[1]), last = (*at)[2].matched ? std::stoul((*at)[2]) : first;
    if (whole ? first <= ports.first && last >= ports.last : first <= ports.last && last >= ports.first) return true;
  }
  return false;
}

// Whether a rule is about all that arrives at the ports, whatever else it asks for.
bool is_about(const std::string& rule, Ports ports) {
  if (has(rule, "tcp ") || has(rule, "icmp") || has(rule, "ct state invalid")) return false;
  return !has(rule, "dport ") || (has(rule, "udp dport ") && names_ports(rule, ports, false));
}

bool accepts(const std::string& rule, Ports ports) {
  return has(rule, "accept") && has(rule, "udp dport ") && names_ports(rule, ports, true);
}

}  // namespace

std::vector<std::string> swallowing_rules(std::string_view ruleset, Ports ports) {
  std::vector<std::string> found;
  std::istringstream lines{std::string{ruleset}};
  bool accepted = false;  // by a rule of this chain before
  std::string policy;     // of this chain, if it drops
  for (std::string rule; std::getline(lines >> std::ws, rule);) {
    if (rule.starts_with("chain ")) {
      accepted = false;
      policy.clear();
    } else if (rule.starts_with("type ")) {
      if (has(rule, "policy drop") && !has(rule, "hook forward")) policy = rule;
    } else if (rule == "}") {
      if (!policy.empty() && !accepted) found.push_back(policy);
      policy.clear();
    } else if (accepts(rule, ports)) {
      accepted = true;
    } else if (!accepted && (has(rule, "drop") || has(rule, "reject")) && is_about(rule, ports)) {
      found.push_back(rule);
    }
  }
  return found;
}

}  // namespace trivela::monitor::network
