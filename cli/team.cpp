#include <fmt/format.h>

#include <memory>

#include "cli/output.hpp"
#include "cli/verbs.hpp"
#include "config/team_check.hpp"

namespace trivela::cli {
namespace {

int check_team(const std::string& file) {
  config::ReadTeam read = config::load_team(file);
  for (std::string& more : config::team_findings(read.team)) read.findings.push_back(std::move(more));
  for (const std::string& finding : read.findings) warn(finding);
  if (!read.findings.empty()) return kFailed;
  const config::Team& team = read.team;
  say(fmt::format("{}: domain {} on each robot, {} between them, {}\n", team.team.name, team.domains.robot,
                  team.domains.team, team.team.group.empty() ? "peers" : "group " + team.team.group));
  for (const config::TeamRobot& robot : team.robots)
    say(fmt::format("{:>6}  {:<15}  {:<8}  {:<12}  {}\n", robot.number, robot.address, team.interface_of(robot),
                    robot.policy ? kicking::name(*robot.policy) : "by settings", robot.robot));
  say(fmt::format("{:>6}  {:<15}  {}\n", "base", team.base.address, team.interface_of_base()));
  return kDone;
}

}  // namespace

void add_team(CLI::App& app, int& exit_code) {
  auto* const verb = app.add_subcommand("team", "A team's machines, described in one file");
  verb->require_subcommand(1);
  auto* const check = verb->add_subcommand("check", "Say everything that is wrong with a team's file");
  auto file = std::make_shared<std::string>("team.toml");
  check->add_option("file", *file, "such as config/teams/example.toml")->capture_default_str();
  check->callback([file, &exit_code] { exit_code = check_team(*file); });
}

}  // namespace trivela::cli
