#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <vector>

#include "cli/collect/fetch.hpp"
#include "cli/launch/progress_bar.hpp"
#include "cli/options/output.hpp"
#include "cli/team/valid_team.hpp"
#include "cli/verbs.hpp"
#include "evaluator/render/text_table.hpp"

namespace trivela::cli {
namespace {

struct CollectArguments {
  std::vector<std::string> hosts;
  std::string to;
  std::string ssh = "ssh";
  std::string folder = ".";
};

/// A file that ends in .toml is a team's and stands for its robots, whose logs are where the team says.
std::vector<LogHost> hosts_of(const CollectArguments& arguments) {
  std::vector<LogHost> hosts;
  for (const std::string& host : arguments.hosts) {
    if (!host.ends_with(".toml")) {
      hosts.push_back(log_host(host, arguments.folder));
      continue;
    }
    const config::Team team = valid_team(host);
    for (const config::TeamRobot& robot : team.robots) hosts.push_back({robot.address, team.team.logs});
  }
  return hosts;
}

int run_collect(const CollectArguments& arguments) {
  const std::vector<LogHost> hosts = hosts_of(arguments);
  require_program("rsync", "apt-get install rsync");
  if (arguments.ssh == "ssh") require_program("ssh", "apt-get install openssh-client");
  std::error_code error;
  std::filesystem::create_directories(arguments.to, error);
  if (error) throw std::runtime_error{fmt::format("cannot make the folder {}: {}", arguments.to, error.message())};
  std::vector<std::vector<std::string>> rows{{"robot", "logs", "here", "still written", "missing"}};
  std::vector<std::string> missing;
  ProgressBar bar;
  double done = 0.0;
  for (const LogHost& host : hosts) {
    bar.show(done++, static_cast<double>(hosts.size()), "robots", host.host);
    const Fetched fetched = fetch_logs(host, arguments.to, arguments.ssh);
    rows.push_back({host.host, std::to_string(fetched.logs), std::to_string(fetched.here),
                    std::to_string(fetched.being_written.size()), std::to_string(fetched.missing.size())});
    for (const std::string& name : fetched.being_written)
      missing.push_back(
          fmt::format("{}: {} is being written; collect again when its recorder has ended", host.host, name));
    for (const std::string& line : fetched.missing) missing.push_back(fmt::format("{}: {}", host.host, line));
  }
  bar.end();
  say(evaluator::text_table(rows) + '\n');
  if (missing.empty()) {
    say("missing: nothing\n");
    return kDone;
  }
  say("missing:\n");
  for (const std::string& line : missing) say("  " + line + '\n');
  return kDoneWithLoss;
}

}  // namespace

void add_collect(CLI::App& app, int& exit_code) {
  const auto [verb, arguments] =
      add_verb(app, exit_code, "collect", "Fetch the finished match logs of a team's robots", run_collect);
  verb->footer(
      R"(By rsync over ssh, with the keys that ssh finds. Logs land in DIR/HOST and are checked there; a broken transfer
goes on where it was. Nothing is changed or deleted on a robot. Logs that are being written are left alone. Ends
with "missing: nothing", or with what is missing and exit code 3. Then: trivela merge OUT DIR/*/*.db)");
  verb->add_option("hosts", arguments->hosts,
                   "A team's file (.toml), or [USER@]HOST[:PATH] of each robot, PATH a folder of logs or one log")
      ->required();
  verb->add_option("--to", arguments->to, "Folder that the logs are put in, made where it is not there")->required();
  add_default(*verb, "--path", arguments->folder, "Folder of the logs on those robots that name none");
  add_default(*verb, "--ssh", arguments->ssh, "Program that runs a command on a host, called as ssh is");
}

}  // namespace trivela::cli
