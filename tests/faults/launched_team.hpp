#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tests/faults/hub.hpp"
#include "tests/faults/network_host.hpp"
#include "tests/faults/node_process.hpp"

namespace trivela::faults {

/// A base and robots as a team has them on the day of a match, each a host of its own on a hub: `trivela team
/// configure` has written its folder `etc`, `trivela-launch` starts what its robot.env says, and its logs are in its
/// own `logs`. Both folders are at the same place on each machine, by a mount that it alone sees. Beside the nodes each
/// robot has a simulator for a world, the base an emulated referee box.
class LaunchedTeam {
 public:
  /// `folder`: exists; everything is written here. `script`: of the box (hal/refbox/box_script.hpp).
  LaunchedTeam(std::filesystem::path folder, std::size_t robots, const std::string& script);
  LaunchedTeam(const LaunchedTeam&) = delete;
  LaunchedTeam& operator=(const LaunchedTeam&) = delete;
  ~LaunchedTeam() { stop(); }

  /// `trivela team configure` on each machine: 0 the base. Throws std::runtime_error with what it said.
  void configure();

  void start();

  /// SIGTERM to the launchers, then to the worlds; waits for them. The launchers' exit codes.
  std::vector<int> stop();

  /// What every way does from now on; `machine` cut off from all others.
  void air(const Way& way);
  void cut(std::size_t machine);

  std::string team_file() const { return (folder_ / "team.toml").string(); }
  /// Where a machine's address and folder of logs are, for `trivela collect`.
  std::string host_of_logs(std::size_t machine) const;
  /// A stand-in for ssh: it runs the command on the machine of the address.
  std::string ssh() const { return (folder_ / "ssh").string(); }

  std::vector<std::filesystem::path> logs(std::size_t machine) const;
  /// What the launcher and the nodes of a machine have said.
  std::string said(std::size_t machine) const;

  /// Whether `condition` came to hold, asked ten times a second, within `patience`.
  bool wait_for(std::chrono::seconds patience, const std::function<bool()>& condition) const;

 private:
  std::filesystem::path machine_folder(std::size_t machine) const;
  ProcessPlan on_machine(std::size_t machine, const std::string& says, std::vector<std::string> command) const;
  void write_team();
  void write_programs() const;

  std::filesystem::path folder_;
  std::string script_;
  std::vector<NetworkHost> hosts_;  // base, robots
  std::unique_ptr<Hub> hub_;
  std::vector<std::unique_ptr<NodeProcess>> launchers_, worlds_;
};

}  // namespace trivela::faults
