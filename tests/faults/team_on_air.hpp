#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "config/settings.hpp"
#include "config/team/team.hpp"
#include "log/read/reader.hpp"
#include "tests/faults/hub.hpp"
#include "tests/faults/network_host.hpp"
#include "tests/faults/node_process.hpp"

namespace trivela::faults {

/// What a machine of the team runs beside recorder and team_link.
enum class Plays {
  kNothing,      ///< it is there and records
  kTeamReferee,  ///< all nodes and a simulator; its referee is the base's
  kOwnReferee,   ///< all nodes and a simulator, whose referee it hears
  kInLockstep,   ///< the same in lockstep: the rows depend on the seed alone
};

struct TeamPlan {
  std::filesystem::path folder;        ///< exists; everything is written here
  std::vector<Plays> robots;           ///< of robot 1, 2, ...
  std::vector<std::int64_t> ahead_ns;  ///< clocks of base, robot 1, ...; missing: 0
  std::string script;                  ///< of the base's emulated referee box (hal/refbox/box_script.hpp)
  bool by_group = true;                ///< discovery by multicast, else peers
  std::filesystem::path keys;          ///< of a secured team; empty: none
  std::vector<std::string> settings;   ///< of every team_link, e.g. "run.memory_limit_mb=64"
  bool link_launched = false;          ///< every team_link by packaging/trivela-launch, which starts it again
  std::uint64_t seed = 1;
};

/// A base and robots, each a host of its own on a hub, with exactly the files that `trivela team configure` makes.
class TeamOnAir {
 public:
  explicit TeamOnAir(const TeamPlan& plan);
  TeamOnAir(const TeamOnAir&) = delete;
  TeamOnAir& operator=(const TeamOnAir&) = delete;
  ~TeamOnAir() { stop(); }

  void start();

  /// SIGTERM to all, the recorders last; waits for them.
  void stop();

  /// What every way does from now on; `machine` cut off from all others where it is one: 0 the base.
  void air(const Way& way);
  void cut(std::size_t machine);

  /// By ioctl on the machine's interface.
  void lose_address(std::size_t machine) { hosts_[machine].lose_address(); }
  void give_address(std::size_t machine) { hosts_[machine].give_address(); }
  void lose_interface(std::size_t machine) { hosts_[machine].lose_interface(); }
  void give_interface(std::size_t machine) { hosts_[machine].give_interface(); }

  NodeProcess& process(std::size_t machine, const std::string& node) { return *processes_.at({machine, node}); }
  void restart(std::size_t machine, const std::string& node);
  /// The process id of a machine's team_link, by whomever it was started; 0: there is none now.
  int link(std::size_t machine) const;

  /// Those that ended, each with its machine.
  std::string casualties();

  std::vector<std::filesystem::path> logs(std::size_t machine) const;
  std::string said(std::size_t machine, const std::string& node) const;
  const Hub& hub() const { return *hub_; }
  const NetworkHost& host(std::size_t machine) const { return hosts_[machine]; }
  /// The tag of a robot's own bus, whose domain is team.domain's 42.
  std::string tag(std::size_t machine) const;
  /// The cable of a host that is no machine of the team, on the same hub.
  const NetworkHost& attacker() const { return hosts_.back(); }

  /// Whether `condition` came to hold, asked ten times a second, within `patience`.
  bool wait_for(std::chrono::seconds patience, const std::function<bool()>& condition);
  /// Waits so long while everything goes on.
  void pass(std::chrono::milliseconds length) const;

 private:
  std::filesystem::path folder_of(std::size_t machine) const;
  void configure(std::size_t machine);
  void start_process(std::size_t machine, const std::string& node, std::vector<std::string> arguments);
  ProcessPlan plan_of(std::size_t machine, const std::string& node) const;

  TeamPlan plan_;
  config::Team team_;
  std::vector<NetworkHost> hosts_;  // base, robots, attacker
  std::unique_ptr<Hub> hub_;
  std::map<std::pair<std::size_t, std::string>, std::unique_ptr<NodeProcess>> processes_;
  std::map<std::pair<std::size_t, std::string>, std::vector<std::string>> arguments_;
};

/// The nodes of a robot's chain, as programs.
extern const std::vector<std::string> kChain;

/// The first number of a query over the newest log of a machine; 0 where there is none yet, or it cannot be read now.
std::int64_t number_in(const std::vector<std::filesystem::path>& logs, const std::string& sql);

/// What stands in the way of clocks of one's own on this machine; empty: nothing.
std::string clock_obstacle();

}  // namespace trivela::faults
