#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>
#include <string>

#include "bus/stop.hpp"
#include "cli/launch/terminal.hpp"
#include "cli/options/bus.hpp"
#include "cli/options/number_checks.hpp"
#include "cli/options/output.hpp"
#include "cli/team/valid_team.hpp"
#include "cli/top/live_bus.hpp"
#include "cli/verbs.hpp"
#include "config/settings.hpp"
#include "config/team/team_settings.hpp"
#include "nodes/runtime/node_main.hpp"

namespace trivela::cli {
namespace {

struct TopFlags : BusFlags {
  std::optional<int> robot;
  bool once = false;
  bool json = false;
  double interval_s = 1.0;
};

/// Draws over what it drew before; the terminal cuts off what is too long, or it would take two lines.
class Redrawn {
 public:
  void draw(const std::string& table) const {
    fmt::print("\x1b[H");
    for (std::size_t begin = 0; begin < table.size();) {
      const std::size_t end = std::min(table.find('\n', begin), table.size());
      fmt::print("\x1b[K");
      say(table.substr(begin, end - begin) + "\n");
      begin = end + 1;
    }
    fmt::print("\x1b[J");
    std::fflush(stdout);
  }
  Redrawn() { fmt::print("\x1b[?7l\x1b[2J"); }
  Redrawn(const Redrawn&) = delete;
  Redrawn& operator=(const Redrawn&) = delete;
  ~Redrawn() { fmt::print("\x1b[?7h"); }
};

/// What the team's file says: of --dds the domain between its machines, else the bus of a robot or of the base.
void look_at_team(const TopFlags& flags, config::Settings& settings) {
  const config::Team team = valid_team(flags.team);
  if (!flags.dds.empty()) {
    settings.domain.domain_id = team.domains.team;
    return;
  }
  const auto number = static_cast<std::uint32_t>(flags.robot.value_or(0));
  const config::TeamRobot* const robot = team.robot(number);
  if (flags.robot && robot == nullptr)
    throw UsageError{fmt::format("--robot {}: {} has no such robot", number, flags.team)};
  settings = robot == nullptr ? config::settings_of_base(team) : config::settings_of(team, *robot);
}

/// Where the flags look. Throws UsageError for those that go against each other.
config::Settings looked_at(const TopFlags& flags) {
  if (!flags.dds.empty() && !flags.keys.empty())
    throw UsageError{"--dds with --secure: between the machines team_link alone has an identity, nobody can look on"};
  config::Settings settings = config::load_settings(flags.config);
  if (flags.robot) settings.run.robot_id = static_cast<std::uint32_t>(*flags.robot);
  if (!flags.team.empty()) look_at_team(flags, settings);
  flags.set(settings.domain);
  return settings;
}

int show_bus(const TopFlags& flags) {
  const config::Settings settings = looked_at(flags);
  bus::Stop stop;
  const bus::StopOnSignals signals{stop};
  std::optional<std::uint8_t> robot;
  if (flags.robot) robot = static_cast<std::uint8_t>(*flags.robot);
  Listening listening{nodes::domain_of(settings, flags.keys, "monitor"), robot};
  const std::chrono::duration<double> interval{flags.interval_s};
  std::optional<Redrawn> terminal;
  if (!flags.once && !flags.json && can_be_drawn_over(STDOUT_FILENO)) terminal.emplace();
  listening.look();  // whose processor time is counted from here on
  for (;;) {
    const auto next =
        std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::steady_clock::duration>(interval);
    if (stop.wait_until(next)) return kDone;
    const monitor::BusPicture picture = listening.look();
    const std::string text = flags.json ? top_json(picture, settings.domain.domain_id)
                                        : lines_cut_to(top_table(picture), columns_of(STDOUT_FILENO));
    if (terminal) {
      terminal->draw(text);
    } else {
      say(text);
      if (!flags.once && !flags.json) say("\n");
      std::fflush(stdout);
    }
    if (flags.once || std::ferror(stdout)) return kDone;
  }
}

}  // namespace

void add_top(CLI::App& app, int& exit_code) {
  const auto [verb, flags] = add_verb(
      app, exit_code, "top", "Show the bus live: rates, latencies, losses, who writes what, what nodes take", show_bus);
  verb->footer(
      R"(Listens and says nothing: no node waits for it. On a terminal it is drawn over until Ctrl-C, in a pipe there is a
table, or a line of JSON, each interval. Latency is from the writer's source timestamp to reception, age from the
message's t_ns; late counts three periods without a sample.)");
  add_bus_flags(*verb, *flags, "whose [domain] is looked at",
                "team.toml that says domain and tag: this machine's own bus, with --robot that robot's, else the "
                "base's; with --dds the domain between the machines");
  verb->add_option("--robot", flags->robot, "this robot's samples and writers only")->check(CLI::Range(1, 255));
  verb->add_flag("--once", flags->once, "show one interval and end");
  verb->add_flag("--json", flags->json, "JSON, a line an interval");
  add_default(*verb, "--interval", flags->interval_s, "seconds between two looks", between(0.1, 3600.0));
}

}  // namespace trivela::cli
