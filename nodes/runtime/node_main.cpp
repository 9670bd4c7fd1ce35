#include "nodes/runtime/node_main.hpp"

#include <fmt/core.h>
#include <poll.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <vector>

#include "bus/domain.hpp"
#include "bus/executor.hpp"
#include "bus/scheduling.hpp"
#include "kicking/text/printable.hpp"

namespace trivela::nodes {

std::chrono::nanoseconds NodeContext::cycle() const {
  return std::chrono::nanoseconds{std::llround(settings.run.cycle_s * 1e9)};
}

void NodeContext::idle(std::chrono::nanoseconds timeout) const {
  pollfd requested{stop.file_descriptor(), POLLIN, 0};
  poll(&requested, 1, static_cast<int>(std::chrono::duration_cast<std::chrono::milliseconds>(timeout).count()));
}

namespace {

bus::DomainConfig domain_of(const config::Domain& domain) {
  return domain.dds_file.empty() ? bus::loopback(domain.domain_id, domain.tag)
                                 : bus::from_file(domain.domain_id, domain.dds_file);
}

std::shared_ptr<spdlog::logger> make_logger(const char* name, const std::string& level) {
  auto logger = spdlog::stderr_logger_mt(name);
  logger->set_level(spdlog::level::from_str(level));
  logger->set_pattern("%H:%M:%S.%e %n %l: %v");
  return logger;
}

}  // namespace

int node_main(int argc, char** argv, const char* name, const std::function<void(NodeContext&)>& body) {
  CLI::App app{fmt::format("Trivela's {} node", name)};
  std::string config_file;
  std::vector<std::string> overrides;
  int realtime_priority = 0;
  app.add_option("--config", config_file, "configuration (config/default.toml says what it may hold)")->required();
  app.add_option("--set", overrides, "one setting on top, e.g. --set run.robot_id=2");
  app.add_option("--realtime", realtime_priority, "SCHED_FIFO priority, locked memory")->check(CLI::Range(1, 99));
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    app.exit(error);
    return 2;
  }
  try {
    bus::Stop stop;
    const bus::StopOnSignals on_signals{stop};
    config::Settings settings = config::load_settings(config_file);
    for (const std::string& line : overrides) config::override_setting(settings, line);
    const config::Robot robot = config::load_robot(settings.run.robot);
    const auto logger = make_logger(name, settings.run.log_level);
    if (realtime_priority > 0 && !bus::set_realtime(realtime_priority).scheduled) {
      logger->warn("real-time scheduling was not permitted");
    }
    NodeContext context{settings, robot, bus::Participant{domain_of(settings.domain)}, logger, stop};
    logger->info("robot {} ({}) in domain {}", settings.run.robot_id, robot.name, settings.domain.domain_id);
    body(context);
    logger->info("stopped");
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", name, kicking::printable_lines(error.what()));
    return 1;
  }
}

void run(NodeContext& context, bus::Node& node) {
  const auto kind = context.settings.run.lockstep ? bus::Executor::kWaitset : bus::Executor::kListener;
  bus::Executor{kind, context.stop, {&node}}.run();
}

}  // namespace trivela::nodes
