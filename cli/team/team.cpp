#include <fmt/core.h>
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "cli/options/output.hpp"
#include "cli/team/valid_team.hpp"
#include "cli/verbs.hpp"
#include "config/team/team_bus.hpp"
#include "config/team/team_settings.hpp"
#include "config/text/installation.hpp"
#include "evaluator/render/write_file.hpp"
#include "log/schema/digest.hpp"

namespace trivela::cli {
namespace {

constexpr std::string_view kSeal = "written by trivela team configure, sha256 of what follows: ";

/// None: there is no such file, or it does not read.
std::optional<std::string> written_text(const std::filesystem::path& path) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return std::nullopt;
  std::ifstream in{path, std::ios::binary};
  std::ostringstream text;
  if (!in || !(text << in.rdbuf())) return std::nullopt;
  return text.str();
}

/// A file's text after a line, a comment of its kind (.xml or #), that has the digest of what follows.
std::string sealed(const config::TeamFile& file) {
  const bool xml = file.name.ends_with(".xml");
  return fmt::format("{} {}{}{}\n{}", xml ? "<!--" : "#", kSeal, log::sha256(file.text), xml ? " -->" : "", file.text);
}

/// Whether a text is as sealed() made it.
bool is_sealed(const std::string& text) {
  const auto line = text.find('\n');
  const auto seal = text.find(kSeal);
  if (line == std::string::npos || seal == std::string::npos || seal > line) return false;
  const auto digest = seal + kSeal.size();
  return text.substr(0, line).substr(digest, 64) == log::sha256(std::string_view{text}.substr(line + 1));
}

/// The files in `folder` that are there and that are not as sealed() made one.
std::vector<std::filesystem::path> edited_files(const std::vector<config::TeamFile>& files,
                                                const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> edited;
  for (const config::TeamFile& file : files) {
    std::error_code unknown;
    const std::filesystem::path path = folder / file.name;
    if (!std::filesystem::exists(std::filesystem::symlink_status(path, unknown))) continue;
    const auto text = written_text(path);
    if (!text || !is_sealed(*text)) edited.push_back(path);
  }
  return edited;
}

/// Writes the files sealed, each whole or not at all, and leaves one alone that is the same already. Returns the
/// written ones. Throws std::runtime_error naming the file.
std::vector<std::filesystem::path> write_sealed(const std::vector<config::TeamFile>& files,
                                                const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> written;
  for (const config::TeamFile& file : files) {
    const std::filesystem::path path = folder / file.name;
    const std::string text = sealed(file);
    if (written_text(path) == text) continue;
    evaluator::replace_file(path, text, "the configuration");
    written.push_back(path);
  }
  return written;
}

int check_team(const std::string& file) {
  const config::Team team = valid_team(file);
  say(fmt::format("{}: domain {} on each robot, {} between them, {}\n", team.team.name, team.domains.robot,
                  team.domains.team, team.team.group.empty() ? "peers" : "group " + team.team.group));
  for (const config::TeamRobot& robot : team.robots)
    say(fmt::format("{:>6}  {:<15}  {:<8}  {:<12}  {}\n", robot.number, robot.address, team.interface_of(robot),
                    robot.policy ? kicking::name(*robot.policy) : "by settings", robot.robot));
  say(fmt::format("{:>6}  {:<15}  {}\n", "base", team.base.address, team.interface_of_base()));
  const config::AirEstimate air = config::air_estimate(team);
  say(fmt::format(
      "on the air, an estimate{}: {:.0f} of {:.0f} kbit/s (referee {:.0f}, team_state {:.0f}, discovery {:.0f})\n",
      team.team.keys.empty() ? "" : " with keys", air.total_bps() / 1e3, team.team.budget_bps / 1e3,
      air.referee_bps / 1e3, air.state_bps / 1e3, air.discovery_bps / 1e3));
  if (team.team.keys.empty())
    say(
        fmt::format("without keys: any program on these networks can stop the robots, order kicks and fire coils; "
                    "team.keys and trivela keys issue change that\n"));
  return kDone;
}

struct ConfigureFlags {
  std::string file = "team.toml";
  std::optional<std::uint32_t> robot;
  bool base = false;
  std::string out;
  bool force = false;
};

int configure_machine(const ConfigureFlags& flags) {
  if (flags.robot.has_value() == flags.base) throw UsageError{"one of --robot N and --base is required"};
  const config::Team team = valid_team(flags.file);
  const config::TeamRobot* const robot = flags.robot ? team.robot(*flags.robot) : nullptr;
  if (flags.robot && robot == nullptr)
    throw UsageError{fmt::format("--robot {}: {} has no such robot", *flags.robot, flags.file)};
  const auto shipped_folder =
      config::trouble_with_folder().empty() ? std::filesystem::absolute(config::folder()).lexically_normal() : "";
  const auto files = config::team_files(team, robot, flags.out, shipped_folder);
  std::filesystem::create_directories(flags.out);
  const auto edited = flags.force ? std::vector<std::filesystem::path>{} : edited_files(files, flags.out);
  for (const auto& path : edited)
    warn(fmt::format("{}: edited by hand, or not written by this verb; --force overwrites it", path.string()));
  if (!edited.empty()) return kFailed;
  const auto written = write_sealed(files, flags.out);
  for (const auto& path : written) say(fmt::format("wrote {}\n", path.string()));
  if (written.empty()) say(fmt::format("{}: nothing to write, all is as configured\n", flags.out));
  return kDone;
}

void add_configure(CLI::App& team, int& exit_code) {
  const auto [verb, flags] =
      add_verb(team, exit_code, "configure", "Write the configuration of one machine of a team", configure_machine);
  add_default(*verb, "file", flags->file, "such as config/teams/example.toml");
  verb->add_option("--robot", flags->robot, "the robot of this number");
  verb->add_flag("--base", flags->base, "the base station");
  verb->add_option("--out", flags->out, "its folder, made where there is none")->required();
  verb->add_flag("--force", flags->force, "overwrite files that were edited by hand");
}

}  // namespace

void add_team(CLI::App& app, int& exit_code) {
  auto* const verb = app.add_subcommand("team", "A team's machines, described in one file");
  verb->require_subcommand(1);
  auto* const check = verb->add_subcommand("check", "Say everything that is wrong with a team's file");
  auto file = std::make_shared<std::string>("team.toml");
  add_default(*check, "file", *file, "such as config/teams/example.toml");
  check->callback([file, &exit_code] { exit_code = check_team(*file); });
  add_configure(*verb, exit_code);
}

}  // namespace trivela::cli
