#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "cli/launch/child_process.hpp"
#include "cli/launch/log_claim.hpp"
#include "cli/launch/progress_bar.hpp"
#include "cli/options/output.hpp"
#include "cli/verbs.hpp"
#include "config/text/installation.hpp"
#include "evaluator/render/text_table.hpp"
#include "evaluator/timeline/decided_again.hpp"
#include "experiment/replay/replay_match.hpp"
#include "kicking/geometry/time.hpp"
#include "log/write/additions.hpp"
#include "robot/recording/session_text.hpp"

namespace trivela::cli {
namespace {

using experiment::RobotSetup;
using log::Reader;
using log::RecordedSession;

struct ReplayFlags {
  std::string log;
  std::string out = "replay.db";
  std::string session;
  std::string robot;
  std::string config;
  std::vector<std::string> overrides;
};

/// What a replay decides by; nothing else of the settings counts.
constexpr std::string_view kSections[] = {"goal.",     "field.",       "rules.",         "policy.",
                                          "odometry.", "world_state.", "kick_decision.", "self_calibration."};

bool counts(std::string_view key) {
  return std::ranges::any_of(kSections, [&](std::string_view section) { return key.starts_with(section); });
}

/// The part of a session's configuration under its "### name" heading; empty: there is none.
std::string part_of(const std::string& config, const std::string& name) {
  const std::string heading = "### " + name + "\n";
  const auto start = config.find(heading);
  if (start == std::string::npos) return "";
  const auto end = config.find("\n### ", start);
  return config.substr(start + heading.size(), end == std::string::npos ? end : end + 1 - start - heading.size());
}

/// The tables of the settings that count: a log of another version or of another machine may have devices, files and
/// keys that nobody knows here.
std::string counting_tables(const std::string& settings) {
  std::string text;
  bool kept = false;
  for (std::size_t at = 0; at < settings.size();) {
    const auto end = std::min(settings.find('\n', at), settings.size() - 1) + 1;
    const std::string line = settings.substr(at, end - at);
    at = end;
    if (line.starts_with('[')) kept = counts(line.substr(1, line.find(']') - 1) + ".");
    if (kept) text += line;
  }
  return text;
}

/// A learned model is a file that may not be on this machine. Where nobody plays by it, it may be missing.
std::string without_missing_model(std::string settings) {
  const auto key = settings.find("\nlearned_model = \"");
  if (key == std::string::npos) return settings;
  const auto start = settings.find('"', key) + 1;
  const std::string file = settings.substr(start, settings.find('"', start) - start);
  if (file.empty() || std::filesystem::exists(file)) return settings;
  warn(fmt::format("the log's kick_decision.learned_model {} is not on this machine: `learned` does not ride along",
                   file));
  return settings.erase(start, file.size());
}

/// Throws std::runtime_error naming the log where it does not say what the robot decided by.
RobotSetup recorded_setup(const RecordedSession& session, const std::string& robot_part, const std::string& log) {
  const std::string settings_text = part_of(session.config_toml, "settings");
  const std::string robot_text = part_of(session.config_toml, robot_part);
  if (settings_text.empty() || robot_text.empty())
    throw std::runtime_error{fmt::format("{}: the session {} holds no settings or no robot", log, session.uuid)};
  const ConfigFile settings_file{without_missing_model(counting_tables(settings_text))};
  const ConfigFile robot_file{robot_text};
  try {
    RobotSetup setup{config::load_settings(settings_file.path()), {}};
    setup.robot = config::robot_for(config::load_robot(robot_file.path()), setup.settings);
    return setup;
  } catch (const config::Error& error) {
    throw std::runtime_error{fmt::format("{}: its own configuration: {}", log, error.what())};
  }
}

/// The other setup; none: nothing is other. Throws UsageError for a setting that plays no part.
std::optional<RobotSetup> other_setup(const RobotSetup& recorded, const ReplayFlags& flags) {
  if (flags.overrides.empty() && flags.robot.empty() && flags.config.empty()) return std::nullopt;
  RobotSetup setup = recorded;
  if (!flags.config.empty()) setup.settings = config::load_settings(flags.config);
  const auto before = config::setting_values(setup.settings);
  config::override_settings(setup.settings, flags.overrides, "--set");
  for (const auto& [key, value] : config::setting_values(setup.settings)) {
    const auto was = before.find(key);
    if ((was == before.end() || value != was->second) && !counts(key))
      throw UsageError{
          fmt::format("--set {} plays no part in a replay: it decides by [goal], [field], [rules], "
                      "[policy], [odometry], [world_state], [kick_decision] and [self_calibration]",
                      key)};
  }
  const config::Robot robot = flags.robot.empty() ? recorded.robot : config::load_robot(flags.robot);
  setup.robot = config::robot_for(robot, setup.settings);
  return setup;
}

/// The session that is meant. Throws UsageError with the sessions that there are, std::runtime_error where none will
/// do.
RecordedSession session_called(const Reader& reader, const ReplayFlags& flags) {
  std::vector<RecordedSession> meant;
  std::string list, replays;
  for (RecordedSession& session : reader.sessions()) {
    if (!session.replays_uuid.empty()) {
      replays = fmt::format(" It holds a {}: decide the recorded log again.", session.scenario);
      continue;
    }
    const auto robots = reader.robots_in("odometry", session.session_id);
    if (robots.empty()) continue;
    list += fmt::format("\n  {}: robot {}", session.uuid, fmt::join(robots, ", "));
    if (session.uuid.starts_with(flags.session)) meant.push_back(std::move(session));
  }
  if (meant.size() == 1) return reader.whole(std::move(meant.front()));
  if (list.empty())
    throw std::runtime_error{
        fmt::format("{}: no session of it has wheel samples: there is nothing to decide again. "
                    "Logs that a recorder made have them.{}",
                    flags.log, replays)};
  throw UsageError{fmt::format("{}: {} of its sessions begin with \"{}\"; --session names one of:{}", flags.log,
                               meant.size(), flags.session, list)};
}

std::string share(std::int64_t part, std::int64_t whole) {
  return fmt::format("{} of {} ({:.2f} %)", part, whole,
                     whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 100.0);
}

/// How far the log's own setup gives again what was recorded: how far to believe the rest.
std::vector<std::string> check_lines(int robot_id, const experiment::ReplayCheck& check, bool lockstep) {
  std::vector<std::string> lines{
      fmt::format("robot {}: {} cycles", robot_id, check.cycles),
      fmt::format("with the log's own settings and robot the same decisions: {}, to the last bit {}",
                  share(check.decisions_same, check.decisions), check.decisions_exact),
      fmt::format("and the same beliefs to the last bit: {}", share(check.beliefs_same, check.beliefs))};
  if (!lockstep)
    lines.push_back(fmt::format("cycles in which inputs crossed, so that another sample counted than the latest: {}",
                                check.crossed));
  if (check.late > 0)
    lines.push_back(fmt::format("cycles that were decided too late then, and are again: {}", check.late));
  if (check.without_odometry > 0)
    lines.push_back(fmt::format("recorded decisions whose wheel sample is not in the log: {}", check.without_odometry));
  return lines;
}

std::string beside_text(Reader& log, const ReplayFlags& flags) {
  Reader again{flags.out};
  std::string text;
  for (const auto& beside : evaluator::decided_again({{&log, flags.log}, {&again, flags.out}})) {
    for (const std::string& sentence : evaluator::sentences_of(beside)) text += sentence + "\n";
    if (!beside.orders.empty()) text += evaluator::text_table(evaluator::table_of(beside));
  }
  return text;
}

/// What the log's configuration and the flags give for each robot.
struct Plan {
  int robot_id = 0;
  RobotSetup recorded;
  std::optional<RobotSetup> other;

  const RobotSetup& decides() const { return other ? *other : recorded; }
};

std::vector<Plan> plans_of(const Reader& reader, const RecordedSession& session, const ReplayFlags& flags) {
  std::vector<Plan> plans;
  for (const int robot_id : reader.robots_in("odometry", session.session_id)) {
    const auto own = fmt::format("robot {}", plans.size() + 1);
    const bool has_own = !plans.empty() && !part_of(session.config_toml, own).empty();
    RobotSetup recorded = recorded_setup(session, has_own ? own : "robot", flags.log);
    auto other = other_setup(recorded, flags);
    plans.push_back({robot_id, std::move(recorded), std::move(other)});
  }
  return plans;
}

log::Session replay_session(const RecordedSession& original, const std::vector<Plan>& plans, const std::string& log) {
  log::Session session;
  session.robot_id = original.robot_id;
  session.started_t_ns = original.started_t_ns;
  session.simulated_clock = original.simulated_clock;
  session.realtime_offset_ns = original.realtime_offset_ns;
  const config::Settings& settings = plans.front().decides().settings;
  std::vector<config::Robot> robots;
  robots.reserve(plans.size());
  for (const Plan& plan : plans) robots.push_back(plan.decides().robot);
  session.config_toml = robot::session_config(settings, robots);
  session.software_version = config::software_version();
  session.scenario = "replay of " + std::filesystem::path{log}.filename().string();
  session.simulated = original.simulated;
  session.idl = robot::idl_text();
  session.policies = robot::session_policies(settings.kick_decision,
                                             std::max<std::size_t>(settings.kick_decision.policy_by_half.size(), 2));
  session.replays_uuid = original.uuid;
  session.paired_halves = original.paired_halves;
  session.planned_s = original.planned_s;
  return session;
}

/// What was decided again, and whether somebody asked to stop before the end.
struct Replayed {
  std::vector<std::string> lines;
  bool stopped = false;
};

Replayed decide_again(const Reader& reader, const RecordedSession& session, const std::vector<Plan>& plans,
                      log::Writer& log, std::size_t queue_capacity) {
  const double all_s = kicking::seconds(session.closed_t_ns.value_or(session.started_t_ns) - session.started_t_ns);
  StoppableBar bar;
  Replayed replayed;
  for (std::size_t i = 0; i < plans.size() && !replayed.stopped; ++i) {
    const auto progress = [&](double done_s) {
      replayed.stopped = !bar.show(static_cast<double>(i) * all_s + done_s, static_cast<double>(plans.size()) * all_s,
                                   "s", "decided again");
      return !replayed.stopped;
    };
    const auto check =
        experiment::replay_robot({reader, session.session_id, plans[i].robot_id, session.simulated_clock},
                                 plans[i].recorded, plans[i].other, log, queue_capacity, progress);
    for (std::string& line : check_lines(plans[i].robot_id, check, session.simulated_clock))
      replayed.lines.push_back(std::move(line));
  }
  return replayed;
}

int replay(const ReplayFlags& flags) {
  Reader reader{flags.log};
  const RecordedSession session = session_called(reader, flags);
  const std::vector<Plan> plans = plans_of(reader, session, flags);
  const LogClaim claim{flags.out};
  log::WriterOptions options;
  options.warn = [](const std::string& line) { warn(line); };
  log::Writer log{flags.out, replay_session(session, plans, flags.log), options};
  const Replayed replayed = decide_again(reader, session, plans, log, options.queue_capacity);
  log.finalise(session.closed_t_ns);
  log::Additions{flags.out}.add(
      log::Note{.session_id = log.session_id(),
                .kind = "note",
                .text = fmt::format("Decided again, open loop: {}", fmt::join(replayed.lines, "; ")),
                .who = "trivela replay"},
      log::utc_now_ns());
  say(fmt::format("{}\n{}", fmt::join(replayed.lines, "\n"), beside_text(reader, flags)));
  if (replayed.stopped) warn(fmt::format("stopped: {} holds what was decided so far", flags.out));
  return replayed.stopped || log.stats().rows_missing > 0 ? kDoneWithLoss : kDone;
}

}  // namespace

void add_replay(CLI::App& app, int& exit_code) {
  const auto [verb, flags] = add_verb(
      app, exit_code, "replay", "Decide a recorded match again, with other settings or another robot file", replay);
  verb->footer(
      R"(The recorded wheel samples, camera frames, commands of the referee and states of the kicker go at their recorded
instants through the robot's logic, in this process: open loop, since nothing that it orders happens. It says
first how far the log's own settings give the recorded decisions again, then what it orders beside what was
ordered. `trivela report LOG OUT --html PAGE` shows both.)");
  verb->add_option("log", flags->log, "match log of a recorder, of a robot or in lockstep")->required();
  add_default(*verb, "--out", flags->out, "log of the replay, must not exist");
  verb->add_option("--session", flags->session, "how the uuid of the session begins, where the log has several");
  verb->add_option("--config", flags->config, "settings in place of the log's")->type_name("FILE");
  verb->add_option("--robot", flags->robot, "robot file in place of the log's")->type_name("FILE");
  verb->add_option("--set", flags->overrides, "one setting on top, e.g. 'kick_decision.policy_by_half=[\"moving\"]'");
}

}  // namespace trivela::cli
