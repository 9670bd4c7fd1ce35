#include "tests/faults/team_on_air.hpp"

#include <fmt/core.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "config/team/team_settings.hpp"
#include "tests/e2e/program.hpp"

namespace trivela::faults {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kGrace{30};

const std::string kLink = "trivela-team_link";

/// The launcher instead of team_link with these arguments: --config FILE, then flags.
void launch(const fs::path& folder, const std::vector<std::string>& arguments, ProcessPlan& plan) {
  const fs::path programs = folder / "programs";
  fs::create_directories(programs);
  // It looks for the nodes beside itself.
  fs::copy_file(TRIVELA_SOURCE_DIR "/packaging/trivela-launch", programs / "trivela-launch",
                fs::copy_options::overwrite_existing);
  if (!fs::exists(programs / kLink)) fs::create_symlink(plan.program, programs / kLink);
  std::string flags;
  for (std::size_t i = 2; i < arguments.size(); ++i) flags += arguments[i] + " ";
  std::ofstream{folder / "link.env"} << fmt::format(
      "TRIVELA_NODES=team_link\nTRIVELA_SETTINGS={}\nTRIVELA_FOLDER={}\nTRIVELA_FLAGS_team_link=\"{}\"\n",
      arguments.at(1), folder.string(), flags);
  plan.program = programs / "trivela-launch";
  plan.arguments = {(folder / "link.env").string()};
}

std::uint8_t number_of(std::size_t machine) { return static_cast<std::uint8_t>(machine == 0 ? 100 : machine); }
std::string address_of(std::size_t machine) { return fmt::format("10.77.0.{}", number_of(machine)); }

config::Team team_of(const TeamPlan& plan) {
  config::Team team;
  team.file = (plan.folder / "team.toml").string();
  team.team.name = fmt::format("air-{}", getpid());
  team.team.number = 39;
  team.team.network = "10.77.0.0/24";
  team.team.interface = "tap0";
  team.team.group = plan.by_group ? "224.16.32.39" : "";
  team.base.address = address_of(0);
  for (std::size_t machine = 1; machine <= plan.robots.size(); ++machine) {
    config::TeamRobot robot;
    robot.number = static_cast<std::uint32_t>(machine);
    robot.address = address_of(machine);
    robot.robot = TRIVELA_SOURCE_DIR "/config/robots/cambada_1.toml";
    team.robots.push_back(robot);
  }
  return team;
}

}  // namespace

const std::vector<std::string> kChain{"trivela-odometry", "trivela-world_state", "trivela-kick_decision",
                                      "trivela-kicker_driver", "trivela-shot_observer"};

std::string clock_obstacle() {
  constexpr int kNewTime = 0x80;  // CLONE_NEWTIME
  const pid_t child = fork();
  if (child == 0) _exit(unshare(kNewTime) == 0 && access("/proc/self/timens_offsets", W_OK) == 0 ? 0 : 1);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? "" : "no time namespaces";
}

std::int64_t number_in(const std::vector<fs::path>& logs, const std::string& sql) {
  if (logs.empty()) return 0;
  std::int64_t number = 0;
  try {
    const log::Reader reader{logs.back()};
    reader.query(sql, [&](std::optional<std::int64_t> cell) { number = cell.value_or(0); });
  } catch (const std::exception&) {
    return 0;  // it is being made
  }
  return number;
}

TeamOnAir::TeamOnAir(const TeamPlan& plan) : plan_(plan), team_(team_of(plan)) {
  std::vector<Hub::Cable> cables;
  for (std::size_t machine = 0; machine <= plan_.robots.size(); ++machine)
    cables.push_back({hosts_.emplace_back(number_of(machine)).cable(), number_of(machine)});
  constexpr std::uint8_t kAttacker = 200;
  cables.push_back({hosts_.emplace_back(kAttacker).cable(), kAttacker});
  hub_ = std::make_unique<Hub>(std::move(cables), plan_.seed);
  for (std::size_t machine = 0; machine <= plan_.robots.size(); ++machine) configure(machine);
}

fs::path TeamOnAir::folder_of(std::size_t machine) const { return plan_.folder / fmt::format("machine_{}", machine); }

void TeamOnAir::configure(std::size_t machine) {
  const fs::path folder = folder_of(machine);
  fs::create_directories(folder);
  team_.team.logs = folder.string();
  const config::TeamRobot* const robot = machine == 0 ? nullptr : team_.robot(static_cast<std::uint32_t>(machine));
  for (const auto& file : config::team_files(team_, robot, folder, "")) std::ofstream{folder / file.name} << file.text;
  std::ofstream{folder / "box.txt"} << plan_.script;
}

ProcessPlan TeamOnAir::plan_of(std::size_t machine, const std::string& node) const {
  ProcessPlan plan;
  plan.program = fs::path{TRIVELA_BINARY_DIR} / node;
  plan.says = folder_of(machine) / (node + ".log");
  plan.network = hosts_[machine].network();
  plan.clock_ahead_ns = machine < plan_.ahead_ns.size() ? plan_.ahead_ns[machine] : 0;
  if (!plan_.keys.empty()) plan.environment["TRIVELA_SECURITY"] = plan_.keys.string();
  return plan;
}

void TeamOnAir::start_process(std::size_t machine, const std::string& node, std::vector<std::string> arguments) {
  ProcessPlan plan = plan_of(machine, node);
  plan.arguments = arguments;
  if (plan_.link_launched && node == kLink) launch(folder_of(machine), arguments, plan);
  arguments_[{machine, node}] = std::move(arguments);
  auto& process = processes_[{machine, node}];
  process.reset();
  process = std::make_unique<NodeProcess>(plan);
}

void TeamOnAir::restart(std::size_t machine, const std::string& node) {
  start_process(machine, node, arguments_.at({machine, node}));
}

void TeamOnAir::start() {
  for (std::size_t machine = 0; machine <= plan_.robots.size(); ++machine) {
    const Plays plays = machine == 0 ? Plays::kNothing : plan_.robots[machine - 1];
    std::vector<std::string> flags{"--config", (folder_of(machine) / "settings.toml").string()};
    const auto set = [&](const std::string& setting) { flags.insert(flags.end(), {"--set", setting}); };
    if (machine > 0) {
      set(fmt::format("simulator.seed={}", plan_.seed * 10 + machine));
      set("simulator.half_minutes=1000");
      set("simulator.halves=1");
      set(fmt::format("simulator.referee={}", plays != Plays::kTeamReferee));
      set(fmt::format("team_link.referee={}", plays == Plays::kTeamReferee || plays == Plays::kNothing));
      if (plays == Plays::kInLockstep) {
        set("run.lockstep=true");
        set("simulator.max_possessions=30");
      }
    }
    std::vector<std::string> of_link = flags;
    for (const std::string& setting : plan_.settings) of_link.insert(of_link.end(), {"--set", setting});
    start_process(machine, "trivela-team_link", of_link);
    start_process(machine, "trivela-recorder", flags);
    if (machine == 0 && !plan_.script.empty()) {
      start_process(0, "trivela-emulate",
                    {"refbox", "--port", "28097", "--script", (folder_of(0) / "box.txt").string()});
      start_process(0, "trivela-refbox", flags);
    }
    if (plays == Plays::kNothing) continue;
    for (const std::string& node : kChain) start_process(machine, node, flags);
    start_process(machine, "trivela-simulator", flags);
  }
}

void TeamOnAir::stop() {
  for (const bool recorders : {false, true}) {
    for (auto& [key, process] : processes_)
      if (recorders == (key.second == "trivela-recorder") && !process->ended()) process->signal(SIGTERM);
    for (auto& [key, process] : processes_) {
      if (recorders != (key.second == "trivela-recorder")) continue;
      pollfd ends{process->file_descriptor(), POLLIN, 0};
      poll(&ends, 1, static_cast<int>(std::chrono::milliseconds{kGrace}.count()));
    }
  }
}

void TeamOnAir::air(const Way& way) {
  Ways ways;
  for (std::size_t from = 0; from < hosts_.size(); ++from)
    for (std::size_t to = 0; to < hosts_.size(); ++to)
      if (from != to) ways[{from, to}] = way;
  hub_->set(std::move(ways));
}

void TeamOnAir::cut(std::size_t machine) {
  Ways ways;
  for (std::size_t other = 0; other < hosts_.size(); ++other)
    if (other != machine) ways[{machine, other}] = ways[{other, machine}] = Way{.drop = 1.0};
  hub_->set(std::move(ways));
}

int TeamOnAir::link(std::size_t machine) const {
  const std::string settings = (folder_of(machine) / "settings.toml").string();
  for (const auto& entry : fs::directory_iterator{"/proc"}) {
    const std::string command = e2e::text_of(entry.path() / "cmdline");  // words behind each of which stands a zero
    const std::string_view program = std::string_view{command}.substr(0, command.find('\0'));
    if (program.ends_with(kLink) && command.find(settings) != std::string::npos)
      return std::stoi(entry.path().filename().string());
  }
  return 0;
}

std::string TeamOnAir::tag(std::size_t machine) const { return config::tag_of(team_, team_.robots.at(machine - 1)); }

std::string TeamOnAir::casualties() {
  std::string found;
  for (auto& [key, process] : processes_)
    if (process->ended())
      found += fmt::format("machine {}: {} ended with {}: {}\n", key.first, key.second, process->code().value_or(-1),
                           said(key.first, key.second));
  return found;
}

std::vector<fs::path> TeamOnAir::logs(std::size_t machine) const {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator{folder_of(machine)})
    if (entry.path().extension() == ".db") found.push_back(entry.path());
  std::ranges::sort(found);
  return found;
}

std::string TeamOnAir::said(std::size_t machine, const std::string& node) const {
  return e2e::text_of(folder_of(machine) / (node + ".log"));
}

bool TeamOnAir::wait_for(std::chrono::seconds patience, const std::function<bool()>& condition) {
  const auto end = Clock::now() + patience;
  while (!condition()) {
    if (Clock::now() > end) return false;
    pass(std::chrono::milliseconds{100});
  }
  return true;
}

void TeamOnAir::pass(std::chrono::milliseconds length) const { poll(nullptr, 0, static_cast<int>(length.count())); }

}  // namespace trivela::faults
