#include <poll.h>

#include <memory>
#include <optional>
#include <string>

#include "cli/launch/signal_inbox.hpp"
#include "cli/open_file.hpp"
#include "cli/sound_team.hpp"
#include "cli/verbs.hpp"
#include "cli/watch/watch_page.hpp"
#include "config/installation.hpp"
#include "config/robot.hpp"
#include "nodes/runtime/node_flags.hpp"

namespace trivela::cli {
namespace {

struct MonitorFlags {
  std::string config = config::shipped("default.toml").string();
  std::optional<std::uint32_t> domain;
  std::string tag;
  std::string team;
  std::string keys;
  WatchFlags watch;
};

/// The team's robots by the names that their files give them.
void name_robots(const std::string& file, pages::SceneSettings& scene) {
  const config::Team team = sound_team(file);
  scene.title = team.team.name;
  for (const config::TeamRobot& robot : team.robots)
    scene.names[static_cast<std::uint8_t>(robot.number)] = config::load_robot(robot.robot).name;
}

int serve_monitor(const MonitorFlags& flags) {
  config::Settings settings = config::load_settings(flags.config);
  if (flags.domain) settings.domain.domain_id = *flags.domain;
  if (!flags.tag.empty()) settings.domain.tag = flags.tag;
  pages::SceneSettings scene = scene_settings(settings);
  if (!flags.team.empty()) name_robots(flags.team, scene);
  SignalInbox signals;  // before all threads, which must not take them
  const WatchPage page{flags.watch, settings, flags.keys, std::move(scene)};
  for (pollfd inbox{signals.file_descriptor(), POLLIN, 0}; !signals.stop_requested();) poll(&inbox, 1, -1);
  return kDone;
}

}  // namespace

void add_monitor(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("monitor", "Serve a live page of a match: field, decisions, kicks, alarms");
  auto flags = std::make_shared<MonitorFlags>();
  verb->footer(
      "It listens and writes nothing on the bus, and the page answers no request but GET: nothing of it can order "
      "anything.\nPrints the page's address and serves it until Ctrl-C.");
  verb->add_option("--config", flags->config, "whose [domain], field and rules are looked at")
      ->check(readable_file())
      ->capture_default_str();
  verb->add_option("--domain", flags->domain, "DDS domain instead of the configuration's")->check(CLI::Range(0, 100));
  verb->add_option("--tag", flags->tag, "discovery tag instead of the configuration's");
  verb->add_option("--team", flags->team, "team.toml that names the robots")->check(readable_file());
  verb->add_option("--secure", flags->keys, "folder of the team's keys with a monitor's in robot_N (trivela keys)")
      ->envname(nodes::kKeysVariable);
  add_watch_flags(*verb, flags->watch);
  verb->callback([flags, &exit_code] { exit_code = serve_monitor(*flags); });
}

}  // namespace trivela::cli
