#include "tests/faults/real_time_stack.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <fstream>
#include <random>
#include <stdexcept>

#include "tests/e2e/log_rows.hpp"

namespace trivela::faults {
namespace {

config::Settings settings_for(const tests::Folder& folder, double minutes, StackOptions options) {
  config::Settings settings = config::load_settings(std::filesystem::path{TRIVELA_SOURCE_DIR} / "config/default.toml");
  std::random_device random;
  settings.run.lockstep = false;
  settings.domain.domain_id = 1 + random() % 100;
  settings.domain.tag = fmt::format("faults-{}-{:08x}", getpid(), random());
  settings.simulator.halves = 1;
  settings.simulator.half_minutes = minutes;
  settings.recorder.log = folder / "match.db";
  settings.kick_decision.standby = options.standby;
  settings.run.one_process = options.one_process;
  settings.run.session = kFirstSession;
  return settings;
}

std::string last_of(const std::string& text) {
  return text.substr(text.size() - std::min<std::size_t>(text.size(), 500));
}

}  // namespace

RealTimeStack::RealTimeStack(double minutes, StackOptions options)
    : settings_(settings_for(folder_, minutes, options)) {
  std::ofstream{folder_ / "nodes.toml"} << config::to_toml_text(settings_);
  start("recorder");
  for (const std::string& node : config::decision_path(settings_)) start(node);
  for (const char* node : {"kicker_driver", "shot_observer"}) start(node);
  if (settings_.kick_decision.standby) start("kick_decision_second");
  for (const auto& started : programs_) {
    const e2e::Program& program = *started.second;
    if (!e2e::wait_for_change(folder_.path(), program.watch(), [&] { return !program.errors().empty(); }))
      throw std::runtime_error{started.first + " says nothing"};
  }
  const e2e::Program& recorder = *programs_.front().second;
  if (!e2e::wait_for_change(folder_.path(), recorder.watch(), [&] { return exists(log()); }))
    throw std::runtime_error{"no log: " + recorder.errors()};
  start("simulator");
  const auto recorded = [this] {
    try {
      return e2e::number_of(e2e::Reader{log()}, "SELECT count(*) FROM drive_commands") > 50;
    } catch (const std::exception&) {
      return false;  // the log is being made
    }
  };
  if (!e2e::wait_for_change(folder_.path(), recorder.watch(), recorded))
    throw std::runtime_error{"nothing is recorded: " + recorder.errors()};
}

void RealTimeStack::start(const std::string& node) { programs_.emplace_back(node, new_program(node)); }

std::unique_ptr<e2e::Program> RealTimeStack::new_program(const std::string& node) const {
  return std::make_unique<e2e::Program>("trivela-" + node, std::vector<std::string>{"--config", "nodes.toml"},
                                        folder_.path());
}

void RealTimeStack::restart(const std::string& name) {
  for (auto& [known, program] : programs_) {
    if (known != name) continue;
    program.reset();
    program = new_program(name);
  }
}

const e2e::Program& RealTimeStack::program(const std::string& name) const {
  for (const auto& [known, program] : programs_)
    if (known == name) return *program;
  throw std::out_of_range{"no program " + name};
}

bool RealTimeStack::wait_for(const std::function<bool()>& condition) const {
  return e2e::wait_for_change(folder_.path(), program("recorder").watch(), condition);
}

void RealTimeStack::signal(const std::string& name, int number) const { program(name).signal(number); }

std::string RealTimeStack::casualties() {
  std::string found;
  for (auto& [node, program] : programs_) {
    if (program->watch().ended(std::chrono::milliseconds{0}))
      found += fmt::format("{} ended with {}: {}\n", node, program->wait(), last_of(program->errors()));
  }
  return found;
}

std::map<std::string, int> RealTimeStack::stop() {
  std::map<std::string, int> codes;
  while (!programs_.empty()) {
    auto& [node, program] = programs_.back();
    program->signal(SIGTERM);
    codes[node] = program->wait();
    programs_.pop_back();
  }
  return codes;
}

std::map<std::string, std::size_t> RealTimeStack::said() const {
  std::map<std::string, std::size_t> bytes;
  for (const auto& [node, program] : programs_) bytes[node] = program->errors().size();
  return bytes;
}

std::string RealTimeStack::errors_of(const std::string& name) const { return program(name).errors(); }

std::int64_t most_worlds_without_drive(const std::filesystem::path& log) {
  return e2e::number_of(e2e::Reader{log}, R"(
    WITH answered AS (
      SELECT w.t_ns, d.t_ns IS NOT NULL AS by_drive
      FROM world_states AS w LEFT JOIN (SELECT DISTINCT t_ns FROM drive_commands) AS d ON d.t_ns = w.t_ns
      WHERE w.t_ns >= (SELECT min(t_ns) FROM drive_commands)),
    runs AS (SELECT by_drive, sum(by_drive) OVER (ORDER BY t_ns) AS run FROM answered)
    SELECT max(n) FROM (SELECT sum(1 - by_drive) AS n FROM runs GROUP BY run))");
}

}  // namespace trivela::faults
