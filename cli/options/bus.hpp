#pragma once

#include <optional>
#include <string>

#include "cli/options/number_checks.hpp"
#include "cli/verbs.hpp"
#include "config/settings.hpp"
#include "config/text/installation.hpp"
#include "nodes/runtime/node_flags.hpp"

namespace trivela::cli {

/// Which bus somebody looks at.
struct BusFlags {
  std::string config = config::shipped("default.toml").string();
  std::optional<std::uint32_t> domain;
  std::string tag;
  std::string dds;
  std::string team;
  std::string keys;

  /// What is said by a flag stands before the configuration.
  void set(config::Domain& of) const {
    if (domain) of.domain_id = *domain;
    if (!tag.empty()) of.tag = tag;
    if (!dds.empty()) of.dds_file = dds;
  }
};

/// --config, --domain, --tag, --dds, --team, --secure; `config` and `team` are the help of theirs.
inline void add_bus_flags(CLI::App& verb, BusFlags& flags, const std::string& config, const std::string& team) {
  add_default(verb, "--config", flags.config, config, readable_file());
  verb.add_option("--domain", flags.domain, "DDS domain instead of the configuration's")->check(CLI::Range(0, 100));
  verb.add_option("--tag", flags.tag, "discovery tag instead of the configuration's");
  verb.add_option("--dds", flags.dds,
                  "Cyclone's configuration of the bus instead, such as a team_bus.xml of trivela team: the bus between "
                  "the machines, in the domain that --team says")
      ->check(readable_file());
  verb.add_option("--team", flags.team, team)->check(readable_file());
  verb.add_option("--secure", flags.keys, "folder of the team's keys with a monitor's in robot_N (trivela keys)")
      ->envname(nodes::kKeysVariable);
}

}  // namespace trivela::cli
