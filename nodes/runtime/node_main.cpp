#include "nodes/runtime/node_main.hpp"

#include <fmt/core.h>
#include <poll.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <deque>
#include <filesystem>

#include "bus/domain/cyclone.hpp"
#include "bus/domain/process.hpp"
#include "bus/domain/reader_health.hpp"
#include "bus/executor.hpp"
#include "config/text/installation.hpp"
#include "kicking/geometry/time.hpp"
#include "kicking/text/printable.hpp"
#include "nodes/runtime/flood_watch.hpp"
#include "nodes/runtime/input_watch.hpp"
#include "nodes/runtime/log_sinks.hpp"
#include "nodes/runtime/node_flags.hpp"
#include "nodes/runtime/standard_streams.hpp"
#include "nodes/runtime/supervisor.hpp"

namespace trivela::nodes {

std::chrono::nanoseconds NodeContext::cycle() const {
  return std::chrono::nanoseconds{kicking::nanoseconds(settings.run.cycle_s)};
}

void NodeContext::idle(std::chrono::nanoseconds timeout) const {
  pollfd requested{stop.file_descriptor(), POLLIN, 0};
  poll(&requested, 1, static_cast<int>(std::chrono::duration_cast<std::chrono::milliseconds>(timeout).count()));
}

void NodeContext::alive() const {
  if (supervisor) supervisor->alive();
}

bus::WatchdogHook NodeContext::watchdog_hook() const {
  if (!supervisor) return {};
  const auto notify = [this](const std::string& late) {
    if (late.empty()) return alive();
    logger->error("{} does not come round: the service manager gets no sign of life", late);
  };
  // In lockstep a reaction may wait for the others' samples.
  const std::chrono::seconds timeout = settings.run.lockstep ? kLockstepTimeout : std::chrono::seconds{1};
  return {.notify = notify, .timeout = timeout};
}

bus::DomainConfig domain_of(const config::Domain& domain) {
  return domain.dds_file.empty() ? bus::loopback(domain.domain_id, domain.tag)
                                 : bus::from_file(domain.domain_id, domain.dds_file);
}

bus::DomainConfig domain_of(const config::Settings& settings, const std::string& keys, std::string_view node) {
  bus::DomainConfig domain = domain_of(settings.domain);
  if (keys.empty()) return domain;
  return bus::secured(domain, std::filesystem::path{keys} / key_folder_of(settings), node);
}

std::string key_folder_of(const config::Settings& settings) {
  return fmt::format("robot_{}", settings.team_link.base ? 0 : settings.run.robot_id);
}

namespace {

std::shared_ptr<spdlog::logger> make_logger(const char* name, const std::string& level) {
  auto logger = std::make_shared<spdlog::logger>(name, std::make_shared<LimitedSink>(std::make_shared<ErrorStream>()));
  logger->set_level(spdlog::level::from_str(level));
  logger->set_pattern("%H:%M:%S.%e %n %l: %v");
  return logger;
}

/// A secured node that hears of others before its own identity stands says that it does not know them yet; a moment
/// later it does. Of an unauthorised one it says something else.
spdlog::level::level_enum level_of(bool severe, std::string_view text) {
  if (severe) return spdlog::level::err;
  const bool of_the_start = text.starts_with("Remote secure participant") && text.find("not allowed") != text.npos;
  return of_the_start ? spdlog::level::debug : spdlog::level::warn;
}

bus::Participant join(const config::Settings& settings, const bus::DomainConfig& domain,
                      const std::shared_ptr<spdlog::logger>& logger, std::chrono::seconds stay) {
  if (settings.run.lockstep) return bus::Participant{domain};
  return {domain, {.warn = [logger](const std::string& line) { logger->warn(line); }, .stay = stay}};
}

/// Runs the body; one that hears nothing any more runs again as a new member of the domain, whom everybody gets to know
/// again. Should that not help either, since the other side is silent, each stays longer than the one before.
void run_as_member(const config::Settings& settings, const config::Robot& robot, const bus::DomainConfig& domain,
                   const std::string& keys, const std::shared_ptr<spdlog::logger>& logger, bus::Stop& stop,
                   const std::function<void(NodeContext&)>& body) {
  const auto supervisor = Supervisor::of_environment();
  constexpr std::chrono::seconds kShortestStay{5};
  constexpr std::chrono::seconds kLongestStay{60};
  for (auto stay = kShortestStay;; stay = std::min(2 * stay, kLongestStay)) {
    try {
      NodeContext context{settings, robot, join(settings, domain, logger, stay), logger, stop};
      context.supervisor = supervisor;
      context.keys = keys;
      logger->info("robot {} ({}) in domain {}{}", settings.run.robot_id, robot.name, settings.domain.domain_id,
                   domain.xml.find("<Security>") == std::string::npos ? "" : ", secured");
      return body(context);
    } catch (const bus::BusUnresponsive& deaf) {
      logger->error("{}: joins the bus again", deaf.what());
    }
  }
}

void say_last(const char* name, const std::string& why) {
  constexpr int kReaderTimeout_ms = 1000;
  write_line(STDERR_FILENO, fmt::format("{}: {}\n", name, why), kReaderTimeout_ms);
}

/// Past the log, of which a flood leaves a few lines a second; the service manager is not to wait for signs of life.
void end_by_itself(const char* name, const std::string& why) {
  say_last(name, why);
  if (const auto manager = Supervisor::of_environment()) manager->stopping();
}

void warn_of_refusals(const bus::Realtime& granted, spdlog::logger& logger) {
  if (!granted.scheduled) logger.warn("real-time scheduling was not permitted");
  if (!granted.memory_locked) logger.warn("memory could not be locked: what was swapped out comes back late");
  if (!granted.processors_awake) logger.warn("/dev/cpu_dma_latency cannot be held: a sleeping processor wakes up late");
}

}  // namespace

int node_main(int argc, char** argv, const char* name, const std::function<void(NodeContext&)>& body) {
  secure_standard_streams();
  std::signal(SIGPIPE, SIG_IGN);  // a node goes on where nobody reads its log lines any more
  std::signal(SIGXFSZ, SIG_IGN);  // at a limit of `ulimit -f` a write fails, as on a full disk
  CLI::App app{fmt::format("Trivela's {} node", name)};
  app.set_version_flag("--version", config::version_lines(fmt::format("trivela-{}", name)));
  NodeFlags flags;
  add_node_flags(app, flags);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    app.exit(error);
    return 2;
  }
  try {
    bus::require_resources();
    bus::Stop stop;
    const bus::StopOnSignals on_signals{stop};
    config::Settings settings = config::load_settings(flags.config_file);
    config::override_settings(settings, flags.overrides, "--set");
    const config::Robot robot = config::robot_for(config::load_robot(settings.run.robot), settings);
    const auto logger = make_logger(name, settings.run.log_level);
    if (flags.processor >= 0) bus::stay_on(flags.processor);
    FloodWatch flood{settings.run.memory_limit_mb, stop, [name](const std::string& why) { end_by_itself(name, why); }};
    if (flags.realtime_priority > 0) {
      const bus::Realtime granted = bus::set_realtime(flags.realtime_priority);
      warn_of_refusals(granted, *logger);
      if (granted.memory_locked) flood.memory_is_locked();
    }
    const bus::LibraryLog library{
        [logger](bool severe, std::string_view text) { logger->log(level_of(severe, text), "dds: {}", text); }};
    run_as_member(settings, robot, domain_of(settings, flags.keys, name), flags.keys, logger, stop, body);
    logger->info("stopped");
    return flood.ended() ? 1 : 0;
  } catch (const std::exception& error) {
    say_last(name, kicking::printable_lines(error.what()));
    return 1;
  }
}

void run(NodeContext& context, const std::vector<bus::Node*>& nodes) {
  const auto kind = context.settings.run.lockstep ? bus::Executor::kWaitset : bus::Executor::kListener;
  std::deque<InputWatch> silences;
  for (bus::Node* const node : nodes) silences.emplace_back(context, *node);
  bus::Executor{kind, context.stop, nodes, context.watchdog_hook()}.run();
}

}  // namespace trivela::nodes
