#include <fmt/chrono.h>
#include <fmt/core.h>

#include <chrono>
#include <cstdio>
#include <memory>

#include "cli/options/output.hpp"
#include "cli/verbs.hpp"
#include "security/key_folder.hpp"
#include "security/rights.hpp"

namespace trivela::cli {
namespace {

using std::chrono::sys_seconds;

struct KeyFlags {
  std::string folder;
  std::vector<std::uint32_t> robots;
  std::vector<std::string> nodes;
  int days = 9;
  std::string from;
  std::string to;
};

/// The beginning of a day "2026-07-01" in UTC.
sys_seconds utc_day(const std::string& text, const char* flag) {
  int year = 0;
  unsigned month = 0;
  unsigned number = 0;
  char rest = 0;
  const int read = std::sscanf(text.c_str(), "%4d-%2u-%2u%c", &year, &month, &number, &rest);
  const std::chrono::year_month_day date{std::chrono::year{year}, std::chrono::month{month}, std::chrono::day{number}};
  if (read != 3 || text.size() != 10 || !date.ok())
    throw UsageError{fmt::format("{}: '{}' is no day such as 2026-07-01", flag, text)};
  return std::chrono::sys_days{date};
}

security::Validity asked_validity(const KeyFlags& flags) {
  if (flags.from.empty()) return security::days_from(security::this_second(), flags.days);
  const security::Validity validity{utc_day(flags.from, "--from"), utc_day(flags.to, "--to") + std::chrono::days{1}};
  if (validity.to <= validity.from) throw UsageError{fmt::format("--to {} is before --from {}", flags.to, flags.from)};
  return validity;
}

void say_keys(const security::KeyFolder& keys, const security::Validity& validity) {
  for (const std::uint32_t robot_id : keys.robots())
    say(fmt::format("{}: {} identities\n", keys.robot_folder(robot_id).string(), keys.nodes(robot_id).size()));
  say(fmt::format("they hold from {:%Y-%m-%d %H:%M} to {:%Y-%m-%d %H:%M} UTC\n", fmt::gmtime(validity.from),
                  fmt::gmtime(validity.to)));
}

void check_key_nodes(const KeyFlags& flags) try {
  for (const std::string& node : flags.nodes) security::rights_of(node);
} catch (const std::invalid_argument& error) {
  throw UsageError{fmt::format("--node: {}", error.what())};
}

/// Issues keys of the robots that are named, after it has called `first`, where that is one.
int make_keys(const KeyFlags& flags, void (security::KeyFolder::*first)(const security::Validity&) const) {
  check_key_nodes(flags);
  const auto validity = asked_validity(flags);
  const security::KeyFolder keys{flags.folder};
  if (first != nullptr) (keys.*first)(validity);
  for (const std::uint32_t robot_id : flags.robots)
    keys.issue(robot_id, flags.nodes.empty() ? security::usual_nodes(robot_id) : flags.nodes, validity);
  say_keys(keys, validity);
  return kDone;
}

int init_keys(const KeyFlags& flags) { return make_keys(flags, &security::KeyFolder::init); }
int issue_keys(const KeyFlags& flags) { return make_keys(flags, nullptr); }
int renew_keys(const KeyFlags& flags) { return make_keys(flags, &security::KeyFolder::renew); }

int revoke_keys(const KeyFlags& flags) {
  check_key_nodes(flags);
  const auto validity = asked_validity(flags);
  const security::KeyFolder keys{flags.folder};
  for (const std::uint32_t robot_id : flags.robots) {
    if (flags.nodes.empty()) {
      keys.revoke_robot(robot_id, validity);
      say(fmt::format(
          "robot {}: forgotten; copy the folders of all others, which have another authority of the team's bus\n",
          robot_id));
      continue;
    }
    for (const std::string& node : flags.nodes) keys.revoke(robot_id, node, validity);
    say(fmt::format("copy {} to the robot and start its nodes again: those that run go on with the old keys\n",
                    keys.robot_folder(robot_id).string()));
  }
  return kDone;
}

int check_keys(const KeyFlags& flags) {
  const security::KeyFolder keys{flags.folder};
  const auto faults = security::faults_of(keys, security::this_second());
  for (const std::string& fault : faults) warn(fault);
  if (!faults.empty()) return kFailed;
  for (const std::uint32_t robot_id : keys.robots())
    say(fmt::format("robot {}: {} identities, nothing wrong\n", robot_id, keys.nodes(robot_id).size()));
  return kDone;
}

using KeyTask = int (*)(const KeyFlags&);

CLI::App* add_key_verb(CLI::App& keys, const char* name, const char* what, const std::shared_ptr<KeyFlags>& flags,
                       KeyTask task, int& exit_code) {
  auto* verb = keys.add_subcommand(name, what);
  verb->add_option("--dir", flags->folder, "folder of the keys")->required();
  verb->callback([flags, task, &exit_code] { exit_code = task(*flags); });
  return verb;
}

void add_key_robots(CLI::App* verb, KeyFlags& flags, const char* nodes) {
  verb->add_option("--robot", flags.robots, "numbers, such as 1,2,3; 0: the base")
      ->delimiter(',')
      ->check(CLI::Range(0, 255))
      ->required();
  verb->add_option("--node", flags.nodes, nodes)->delimiter(',');
}

void add_key_validity(CLI::App* verb, KeyFlags& flags) {
  auto* days =
      add_default(*verb, "--days", flags.days,
                  "how long they hold from now: a tournament's week and a day on each side", CLI::Range(1, 366));
  auto* from = verb->add_option("--from", flags.from, "first day, e.g. 2026-07-01 (UTC)")->excludes(days);
  auto* to = verb->add_option("--to", flags.to, "last day (UTC)")->needs(from);
  from->needs(to);
}

}  // namespace

void add_keys(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("keys", "Identities and rights of a team's nodes, for --secure");
  verb->require_subcommand(1);
  auto flags = std::make_shared<KeyFlags>();
  auto* made = add_key_verb(*verb, "init", "Make authorities, and keys of the robots", flags, init_keys, exit_code);
  add_key_robots(made, *flags, "nodes such as kick_decision,recorder; default: all that run on a robot");
  add_key_validity(made, *flags);
  auto* more = add_key_verb(*verb, "issue", "Add a robot, or nodes to one; all of its nodes get new keys", flags,
                            issue_keys, exit_code);
  add_key_robots(more, *flags, "nodes, simulator only by name; default: all that run on a robot");
  add_key_validity(more, *flags);
  auto* next = add_key_verb(*verb, "renew", "New keys for all, of the same names, for another week", flags, renew_keys,
                            exit_code);
  add_key_validity(next, *flags);
  auto* lost =
      add_key_verb(*verb, "revoke", "Count a node's keys, or a whole robot's, no more", flags, revoke_keys, exit_code);
  add_key_robots(lost, *flags, "the node whose keys are lost; default: the whole robot");
  add_key_validity(lost, *flags);
  add_key_verb(*verb, "check", "Say what is wrong with the keys, on a robot too", flags, check_keys, exit_code);
}

}  // namespace trivela::cli
