#include "cli/launch/signals.hpp"
#include "cli/options/bus.hpp"
#include "cli/team/valid_team.hpp"
#include "cli/verbs.hpp"
#include "cli/watch/watch_page.hpp"
#include "config/robot.hpp"

namespace trivela::cli {
namespace {

struct MonitorFlags : BusFlags {
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
  flags.set(settings.domain);
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
      R"(It listens and writes nothing on the bus, and the page answers no request but GET: nothing of it can order anything.
Prints the page's address and serves it until Ctrl-C.)");
  add_bus_flags(*verb, *flags, "whose [domain], field and rules are looked at", "team.toml that names team and robots");
  add_watch_flags(*verb, flags->watch);
}

}  // namespace trivela::cli
