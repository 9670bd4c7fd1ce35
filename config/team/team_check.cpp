#include "config/team/team.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>

#include "config/robot.hpp"
#include "config/team/team_bus.hpp"
#include "config/team/team_settings.hpp"
#include "config/text/error.hpp"
#include "config/text/ipv4.hpp"

namespace trivela::config {
namespace {

constexpr std::uint32_t kLastDomain = 100;  // 7400 + 250 * 101 + 249 lies where Linux gives out ephemeral ports
constexpr std::size_t kLongestTeamName = 32;
constexpr std::size_t kLongestInterface = 15;  // IFNAMSIZ less the end

/// Everything that is wrong, in the order in which it was looked for.
class TeamCheck {
 public:
  explicit TeamCheck(const Team& team) : team_(team), network_(network(team.team.network)) {}

  std::vector<std::string> findings() {
    check_name();
    check_network();
    check_discovery();
    check_domains();
    check_base();
    if (team_.robots.empty()) found_.push_back(fmt::format("{}: no [[robot]]: a team has one at least", team_.file));
    for (const TeamRobot& robot : team_.robots) check_robot(robot);
    check_budget();
    return std::move(found_);
  }

 private:
  void add(const Lines& lines, const char* key, const std::string& what) {
    found_.push_back(fmt::format("{}: {}", team_.place(lines, key), what));
  }

  void check_name() {
    const TeamFields& t = team_.team;
    constexpr std::string_view kAllowed = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-";
    if (t.name.empty() || t.name.size() > kLongestTeamName || t.name.find_first_not_of(kAllowed) != std::string::npos) {
      add(t.lines, "name",
          fmt::format("team.name = \"{}\": must be 1 to {} of A-Z a-z 0-9 . _ -, for tags and names of logs", t.name,
                      kLongestTeamName));
    }
    check_folder("logs", t.logs);
    if (!t.keys.empty()) check_folder("keys", t.keys);
  }

  /// On the machines, where the units see no homes.
  void check_folder(const char* key, const std::string& folder) {
    const auto wrong = [&](const char* why) {
      add(team_.team.lines, key, fmt::format("team.{} = \"{}\": {}", key, folder, why));
    };
    if (!folder.starts_with('/')) return wrong("must be a whole path on the robots");
    const std::string path = std::filesystem::path{folder}.lexically_normal().string() + "/";
    for (const char* const home : {"/home/", "/root/", "/run/user/"})
      if (path.starts_with(home)) wrong("lies in a home, which the nodes' units do not see (ProtectHome)");
  }

  void check_network() {
    const TeamFields& t = team_.team;
    if (!network_) {
      add(t.lines, "network",
          fmt::format("team.network = \"{}\": must be such as 172.16.39.0/24, no bits beyond the "
                      "network's",
                      t.network));
    }
    check_interface(t.lines, "team.interface", t.interface);
  }

  void check_interface(const Lines& lines, const char* key, const std::string& name) {
    const bool plain = std::ranges::all_of(
        name, [](unsigned char c) { return c > ' ' && c < 127 && std::strchr("/<>&\"'", c) == nullptr; });
    if (!name.empty() && name.size() <= kLongestInterface && plain) return;
    add(lines, "interface", fmt::format("{} = \"{}\": is no name of an interface", key, name));
  }

  void check_discovery() {
    const TeamFields& t = team_.team;
    if (!t.group.empty() && !t.peers.empty())
      add(t.lines, "peers", "team.peers: has no use beside team.group; leave one out");
    for (const std::string& peer : t.peers) check_address(t.lines, "peers", "team.peers", peer);
    if (t.group.empty()) return;
    const auto group = ipv4(t.group);
    const auto wrong = [&](const char* why) {
      add(t.lines, "group", fmt::format("team.group = \"{}\": {}", t.group, why));
    };
    if (!group || *group >> 28 != 0xE) {
      wrong("is no multicast address, 224.0.1.0 to 239.255.255.255");
    } else if (*group >> 8 == 0xE00000) {
      wrong("belongs to the routers' own protocols");
    } else if (t.group == "239.255.0.1") {
      wrong("is the default of DDS, which other teams may use; the league's are 224.16.32.N");
    }
  }

  void check_domains() {
    const TeamDomains& d = team_.domains;
    const auto range = [&](const char* key, std::uint32_t domain) {
      if (domain <= kLastDomain) return;
      add(d.lines, key,
          fmt::format("domains.{} = {}: its ports {} to {} lie among those that Linux gives out (32768 and above); at "
                      "most {}",
                      key, domain, first_port(domain), last_port(domain), kLastDomain));
    };
    range("robot", d.robot);
    range("team", d.team);
    if (d.robot != d.team) return;
    add(d.lines, d.lines.contains("team") ? "team" : "robot",
        fmt::format("domains.team = {0} and domains.robot = {0}: both have the ports {1} to {2}; choose two", d.team,
                    first_port(d.team), last_port(d.team)));
  }

  void check_base() {
    if (team_.base.lines.empty()) {
      found_.push_back(fmt::format("{}: no [base]: which machine runs refbox?", team_.file));
      return;
    }
    check_address(team_.base.lines, "address", "base.address", team_.base.address);
    if (!team_.base.interface.empty()) check_interface(team_.base.lines, "base.interface", team_.base.interface);
  }

  void check_address(const Lines& lines, const char* key, const std::string& name, const std::string& text) {
    const auto address = ipv4(text);
    if (!address) {
      add(lines, key, fmt::format("{} = \"{}\": is no IPv4 address", name, text));
    } else if (network_ && !network_->has_machine(*address)) {
      add(lines, key,
          fmt::format("{} = \"{}\": {}", name, text,
                      network_->contains(*address) ? "is the network's own or its broadcast"
                                                   : fmt::format("lies outside the network {}", team_.team.network)));
    }
  }

  void check_robot(const TeamRobot& robot) {
    const std::string who = fmt::format("robot {}", robot.number);
    if (robot.number == 0 && !robot.lines.contains("number"))
      add(robot.lines, "number", "robot.number is missing: 1 to 255");
    check_twins(robot, who);
    check_address(robot.lines, "address", who + ": address", robot.address);
    if (!robot.interface.empty()) check_interface(robot.lines, "robot.interface", robot.interface);
    check_files(robot, who);
  }

  void check_twins(const TeamRobot& robot, const std::string& who) {
    for (const TeamRobot& before : team_.robots) {
      if (&before == &robot) break;
      if (before.number == robot.number && robot.number != 0)
        add(robot.lines, "number", fmt::format("{}: another one at {}", who, team_.place(before.lines, "number")));
      if (before.address == robot.address && !robot.address.empty())
        add(robot.lines, "address",
            fmt::format("{}: address = \"{}\" is robot {}'s, too ({})", who, robot.address, before.number,
                        team_.place(before.lines, "address")));
    }
    if (robot.address == team_.base.address && !robot.address.empty())
      add(robot.lines, "address", fmt::format("{}: address = \"{}\" is the base's, too", who, robot.address));
  }

  /// Of its files, which do not read, and whether it can play its policy.
  void check_files(const TeamRobot& robot, const std::string& who) {
    Settings settings;
    if (robot.robot.empty()) add(robot.lines, "robot", who + ": robot is missing: its file");
    try {
      settings = settings_of(team_, robot);
      for (const kicking::PolicyName policy : in_charge(settings)) check_policy(robot, who, policy);
    } catch (const Error& wrong) {
      add(robot.lines, robot.policy ? "policy" : "settings", fmt::format("{}: {}", who, wrong.what()));
    }
    if (robot.robot.empty()) return;
    try {
      const Robot read = robot_for(load_robot(robot.robot), settings);
      hal_for(settings.hal, read);
    } catch (const Error& wrong) {
      add(robot.lines, "robot", fmt::format("{}: {}", who, wrong.what()));
    }
  }

  void check_policy(const TeamRobot& robot, const std::string& who, kicking::PolicyName policy) {
    const char* const why = facts(policy).needs_truth() ? "needs the simulator's truth, which nobody has on a field"
                            : !facts(policy).plays()    ? "calibrates a robot and plays no match"
                                                        : nullptr;
    if (why != nullptr) add(robot.lines, "policy", fmt::format("{}: policy \"{}\" {}", who, name(policy), why));
  }

  void check_budget() {
    const AirEstimate air = air_estimate(team_);
    if (air.total_bps() <= team_.team.budget_bps) return;
    add(team_.team.lines, "budget_bps",
        fmt::format(
            "team.budget_bps = {}: {} robots and a base need {:.0f} bit/s, an estimate (referee {:.0f}, team_state "
            "{:.0f}, discovery {:.0f})",
            team_.team.budget_bps, team_.robots.size(), air.total_bps(), air.referee_bps, air.state_bps,
            air.discovery_bps));
  }

  const Team& team_;
  std::optional<Network> network_;
  std::vector<std::string> found_;
};

}  // namespace

std::vector<std::string> team_findings(const Team& team) { return TeamCheck{team}.findings(); }

}  // namespace trivela::config
