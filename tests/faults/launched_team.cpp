#include "tests/faults/launched_team.hpp"

#include <fmt/core.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "tests/e2e/program.hpp"

namespace trivela::faults {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds kGrace{40};
constexpr const char* kBoxPort = "28097";

std::uint8_t number_of(std::size_t machine) { return static_cast<std::uint8_t>(machine == 0 ? 100 : machine); }
std::string address_of(std::size_t machine) { return fmt::format("10.77.0.{}", number_of(machine)); }

void write_script(const fs::path& path, const std::string& text) {
  std::ofstream{path} << "#!/bin/sh\n" << text;
  fs::permissions(path, fs::perms::owner_all);
}

/// Waits for it; kills it, and the nodes of a launcher with it, where that takes longer than kGrace.
int code_of(NodeProcess& process) {
  pollfd ends{process.file_descriptor(), POLLIN, 0};
  poll(&ends, 1, static_cast<int>(std::chrono::milliseconds{kGrace}.count()));
  if (!process.ended()) kill(-process.pid(), SIGKILL);
  poll(&ends, 1, static_cast<int>(std::chrono::milliseconds{kGrace}.count()));
  return process.code().value_or(-1);
}

}  // namespace

LaunchedTeam::LaunchedTeam(fs::path folder, std::size_t robots, const std::string& script)
    : folder_(std::move(folder)), script_(script) {
  std::vector<Hub::Cable> cables;
  for (std::size_t machine = 0; machine <= robots; ++machine) {
    cables.push_back({hosts_.emplace_back(number_of(machine)).cable(), number_of(machine)});
    for (const char* const own : {"etc", "logs"}) fs::create_directories(machine_folder(machine) / own);
  }
  hub_ = std::make_unique<Hub>(std::move(cables), 1);
  write_team();
  write_programs();
}

fs::path LaunchedTeam::machine_folder(std::size_t machine) const { return folder_ / address_of(machine); }

void LaunchedTeam::write_team() {
  std::ofstream{folder_ / "match.toml"} << "[simulator]\nhalves = 1\nhalf_minutes = 1000\nreferee = false\n";
  std::ofstream team{folder_ / "team.toml"};
  team << fmt::format(
      "[team]\nname = \"launched-{}\"\nnumber = 39\nnetwork = \"10.77.0.0/24\"\ninterface = \"tap0\"\ngroup = "
      "\"224.16.32.39\"\nsettings = \"match.toml\"\nlogs = \"{}\"\n\n[base]\naddress = \"{}\"\n",
      getpid(), (folder_ / "logs").string(), address_of(0));
  for (std::size_t robot = 1; robot < hosts_.size(); ++robot)
    team << fmt::format("\n[[robot]]\nnumber = {}\naddress = \"{}\"\nrobot = \"{}/config/robots/cambada_{}.toml\"\n",
                        robot, address_of(robot), TRIVELA_SOURCE_DIR, robot);
}

void LaunchedTeam::write_programs() const {
  for (const char* const own : {"etc", "logs", "bin"}) fs::create_directory(folder_ / own);
  fs::copy_file(TRIVELA_SOURCE_DIR "/packaging/trivela-launch", folder_ / "bin/trivela-launch");
  for (const auto& entry : fs::directory_iterator{TRIVELA_BINARY_DIR})
    if (entry.path().filename().string().starts_with("trivela") && entry.is_regular_file())
      fs::create_symlink(entry.path(), folder_ / "bin" / entry.path().filename());
  write_script(
      folder_ / "on",
      "# on ADDRESS COMMAND...: where the machine's own etc and logs are mounted. What is mounted is private; in a\n"
      "# chroot the root is no mount of its own, and stays what it is.\n"
      "here=$(dirname \"$0\"); address=$1; shift\n"
      "exec unshare --mount --propagation unchanged sh -c 'mount --make-rprivate / 2>/dev/null; mount --bind "
      "\"$0/etc\" \"$1/etc\" && mount --bind \"$0/logs\" \"$1/logs\" "
      "&& shift && exec \"$@\"' \"$here/$address\" \"$here\" \"$@\"\n");
  write_script(folder_ / "ssh",
               "while [ \"$1\" = -o ] || [ \"$1\" = -l ]; do shift 2; done\n"
               "address=$1; shift\nexec \"$(dirname \"$0\")/on\" \"$address\" sh -c \"$*\"\n");
  std::ofstream{folder_ / "box.txt"} << script_;
}

ProcessPlan LaunchedTeam::on_machine(std::size_t machine, const std::string& says,
                                     std::vector<std::string> command) const {
  ProcessPlan plan;
  plan.program = folder_ / "on";
  plan.arguments = std::move(command);
  plan.arguments.insert(plan.arguments.begin(), address_of(machine));
  plan.says = machine_folder(machine) / (says + ".log");
  plan.network = hosts_[machine].network();
  return plan;
}

void LaunchedTeam::configure() {
  for (std::size_t machine = 0; machine < hosts_.size(); ++machine) {
    std::vector<std::string> command{(folder_ / "bin/trivela").string(), "team", "configure", team_file(), "--out",
                                     (folder_ / "etc").string()};
    if (machine == 0) command.emplace_back("--base");
    if (machine > 0) command.insert(command.end(), {"--robot", std::to_string(machine)});
    NodeProcess verb{on_machine(machine, "configure", command)};
    if (code_of(verb) != 0) throw std::runtime_error{e2e::text_of(machine_folder(machine) / "configure.log")};
  }
}

void LaunchedTeam::start() {
  const auto own = [&](const char* name) { return (folder_ / name).string(); };
  for (std::size_t machine = 0; machine < hosts_.size(); ++machine) {
    launchers_.push_back(std::make_unique<NodeProcess>(
        on_machine(machine, "launch", {own("bin/trivela-launch"), own("etc/robot.env")})));
    const std::vector<std::string> world =
        machine == 0 ? std::vector<std::string>{own("bin/trivela-emulate"),
                                                "refbox",
                                                "--port",
                                                kBoxPort,
                                                "--script",
                                                own("box.txt")}
                     : std::vector<std::string>{own("bin/trivela-simulator"), "--config", own("etc/settings.toml"),
                                                "--set", fmt::format("simulator.seed={}", machine)};
    worlds_.push_back(std::make_unique<NodeProcess>(on_machine(machine, "world", world)));
  }
}

std::vector<int> LaunchedTeam::stop() {
  std::vector<int> codes;
  for (const auto& launcher : launchers_) launcher->signal(SIGTERM);
  for (const auto& launcher : launchers_) codes.push_back(code_of(*launcher));
  for (const auto& world : worlds_) world->signal(SIGTERM);
  for (const auto& world : worlds_) code_of(*world);
  launchers_.clear();
  worlds_.clear();
  return codes;
}

void LaunchedTeam::air(const Way& way) {
  Ways ways;
  for (std::size_t from = 0; from < hosts_.size(); ++from)
    for (std::size_t to = 0; to < hosts_.size(); ++to)
      if (from != to) ways[{from, to}] = way;
  hub_->set(std::move(ways));
}

void LaunchedTeam::cut(std::size_t machine) {
  Ways ways;
  for (std::size_t other = 0; other < hosts_.size(); ++other)
    if (other != machine) ways[{machine, other}] = ways[{other, machine}] = Way{.drop = 1.0};
  hub_->set(std::move(ways));
}

std::string LaunchedTeam::host_of_logs(std::size_t machine) const {
  return fmt::format("{}:{}", address_of(machine), (folder_ / "logs").string());
}

std::vector<fs::path> LaunchedTeam::logs(std::size_t machine) const {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator{machine_folder(machine) / "logs"})
    if (entry.path().extension() == ".db") found.push_back(entry.path());
  std::ranges::sort(found);
  return found;
}

std::string LaunchedTeam::said(std::size_t machine) const {
  std::string text;
  for (const fs::path& place : {machine_folder(machine), machine_folder(machine) / "logs"})
    for (const auto& entry : fs::directory_iterator{place})
      if (entry.path().extension() == ".log")
        text += fmt::format("{}:\n{}", entry.path().filename().string(), e2e::text_of(entry.path()));
  return text;
}

bool LaunchedTeam::wait_for(std::chrono::seconds patience, const std::function<bool()>& condition) const {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    poll(nullptr, 0, 100);
  }
  return true;
}

}  // namespace trivela::faults
