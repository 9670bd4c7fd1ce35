
#include <optional>
#include <string>

#include "cli/launch/signal_inbox.hpp"
#include "cli/options/number_checks.hpp"
#include "cli/team/valid_team.hpp"
#include "cli/verbs.hpp"
#include "cli/watch/watch_page.hpp"
#include "config/robot.hpp"
#include "config/text/installation.hpp"
#include "nodes/runtime/node_flags.hpp"

namespace trivela::cli {
namespace {

struct MonitorFlags {
  std::string config = config::shipped("default.toml").string();
  std::optional<std::uint32_t> domain;
  std::string tag;
  std::string dds;
  std::string team;
  std::string keys;
  WatchFlags watch;
};

/// What the team's file says: names, and the domain of the bus between its machines, where that is looked at.
void look_at_team(const MonitorFlags& flags, config::Settings& settings, pages::SceneSettings& scene) {
  const config::Team team = valid_team(flags.team);
  scene.title = team.team.name;
  for (const config::TeamRobot& robot : team.robots)
    scene.names[static_cast<std::uint8_t>(robot.number)] = config::load_robot(robot.robot).name;
  if (!flags.dds.empty()) settings.domain.domain_id = team.domains.team;
}

int serve_monitor(const MonitorFlags& flags) {
  config::Settings settings = config::load_settings(flags.config);
  pages::SceneSettings scene = scene_settings(settings);
  if (!flags.team.empty()) look_at_team(flags, settings, scene);
  if (flags.domain) settings.domain.domain_id = *flags.domain;
  if (!flags.tag.empty()) settings.domain.tag = flags.tag;
  if (!flags.dds.empty()) settings.domain.dds_file = flags.dds;
  SignalInbox signals;  // before all threads, which must not take them
  const WatchPage page{flags.watch, settings, flags.keys, std::move(scene)};
  while (!signals.stop_requested_within(-1)) continue;
  return kDone;
}

}  // namespace

void add_monitor(CLI::App& app, int& exit_code) {
  const auto [verb, flags] = add_verb(app, exit_code, "monitor",
                                      "Serve a live page of a match: field, decisions, kicks, alarms", serve_monitor);
  verb->footer(
      "It listens and writes nothing on the bus, and the page answers no request but GET: nothing of it can order "
      "anything.\nPrints the page's address and serves it until Ctrl-C.");
  add_default(*verb, "--config", flags->config, "whose [domain], field and rules are looked at", readable_file());
  verb->add_option("--domain", flags->domain, "DDS domain instead of the configuration's")->check(CLI::Range(0, 100));
  verb->add_option("--tag", flags->tag, "discovery tag instead of the configuration's");
  verb->add_option("--dds", flags->dds,
                   "Cyclone's configuration of the bus instead, such as a team_bus.xml of trivela team: the bus "
                   "between the machines, in the domain that --team says")
      ->check(readable_file());
  verb->add_option("--team", flags->team, "team.toml that names team and robots")->check(readable_file());
  verb->add_option("--secure", flags->keys, "folder of the team's keys with a monitor's in robot_N (trivela keys)")
      ->envname(nodes::kKeysVariable);
  add_watch_flags(*verb, flags->watch);
}

}  // namespace trivela::cli
