#include <algorithm>
#include <charconv>
#include <sstream>

#include "monitor/network/findings.hpp"

namespace trivela::monitor::network {
namespace {

bool has(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

// "7400", "7400-7649", "{ 53, 7400-7649 }" after "dport ": whether one of the numbers or ranges touches the ports; with
// `whole` whether one covers them all.
bool names_ports(std::string_view rule, Ports ports, bool whole) {
  std::string_view rest = rule.substr(rule.find("dport ") + 6);
  rest = rest.substr(0, rest.starts_with('{') ? rest.find('}') : rest.find(' '));
  const char* at = rest.data();
  const char* const end = rest.data() + rest.size();
  while (at < end) {
    unsigned first = 0;
    const auto read = std::from_chars(at, end, first);
    if (read.ec != std::errc{}) {
      ++at;
      continue;
    }
    at = read.ptr;
    unsigned last = first;
    if (at < end && *at == '-') at = std::from_chars(at + 1, end, last).ptr;
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

std::string trimmed(const std::string& line) {
  const auto begin = line.find_first_not_of(" \t");
  return begin == std::string::npos ? "" : line.substr(begin);
}

}  // namespace

std::vector<std::string> swallowing_rules(std::string_view ruleset, Ports ports) {
  std::vector<std::string> found;
  std::istringstream lines{std::string{ruleset}};
  bool accepted = false;  // by a rule of this chain before
  std::string policy;     // of this chain, if it drops
  for (std::string line; std::getline(lines, line);) {
    const std::string rule = trimmed(line);
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
