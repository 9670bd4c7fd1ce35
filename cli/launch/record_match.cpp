#include "cli/launch/record_match.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <random>

#include "cli/launch/child_process.hpp"
#include "cli/launch/signals.hpp"
#include "cli/options/output.hpp"
#include "cli/verbs.hpp"
#include "log/read/reader.hpp"
#include "nodes/runtime/node_flags.hpp"

namespace trivela::cli {
namespace {

namespace fs = std::filesystem;

/// The live page of a match that this process plays.
class MatchWatch {
 public:
  /// Serves it and prints its address; `flags` nullptr: nobody watches. `settings`: of the run, with its domain. Throws
  /// what WatchPage does.
  MatchWatch(const WatchFlags* flags, const config::Settings& settings) {
    if (flags == nullptr) return;
    const char* const keys = std::getenv(nodes::kKeysVariable);  // as the nodes find them
    page_.emplace(*flags, settings, keys == nullptr ? "" : keys, scene_settings(settings));
  }

  /// A match that was played to its end stays to be looked at until somebody asks to stop.
  void stay_after(const MatchResult& result, SignalInbox& signals) {
    if (!page_ || !result.trouble.empty()) return;
    page_->note_over();
    say("the match is over; its page stays until Ctrl-C\n");
    std::fflush(stdout);
    while (!signals.stop_requested_within(-1)) continue;
  }

 private:
  std::optional<WatchPage> page_;
};

}  // namespace

std::int64_t lost_rows(const std::string& log) {
  std::int64_t missing = 0;
  for (const auto& loss : log::Reader{log, log::Check::kQuick}.losses()) missing += loss.missing();
  if (missing > 0) fmt::print(stderr, "trivela: {} rows are missing in {}: trivela report says which\n", missing, log);
  return missing;
}

std::vector<std::string> nodes_of_match(const config::Settings& settings) {
  std::vector<std::string> nodes{"recorder"};
  for (const std::string& node : config::decision_path(settings)) nodes.push_back(node);
  nodes.emplace_back("kicker_driver");
  nodes.emplace_back("shot_observer");
  if (settings.scan_recorder.enabled) nodes.emplace_back("scan_recorder");
  return nodes;
}

config::Settings match_settings(config::Settings settings, int domain, const std::string& log) {
  // Runs at the same time hear each other in neither domain nor tag.
  std::random_device random;
  settings.domain.domain_id = domain >= 0 ? static_cast<std::uint32_t>(domain) : 1 + random() % 100;
  settings.domain.tag = fmt::format("run-{}-{:08x}", getpid(), random());
  settings.recorder.log = fs::absolute(log).string();
  settings.scan_recorder.file = fs::absolute(settings.scan_recorder.file).string();
  config::make_files_whole(settings);
  return settings;
}

config::Settings lockstep_settings(config::Settings settings, int domain, const std::string& log) {
  settings = match_settings(std::move(settings), domain, log);
  settings.run.lockstep = true;
  return settings;
}

void refuse_real_devices(const config::Hal& devices) {
  const auto look = [](const char* key, const auto& device) {
    if (plays_in_lockstep(device)) return;
    throw UsageError{fmt::format("{} = \"{}\" plays with --devices emulated alone", key, config::text_of(device))};
  };
  look("hal.wheels", devices.wheels);
  look("hal.gyro", devices.gyro);
  look("hal.kicker", devices.kicker);
}

int say_how_it_went(const MatchResult& result, const LogClaim& log, const std::string& out) {
  fmt::print("played {:.0f} s in {:.1f} s: {:.1f} times real time\n", result.played_s, result.wall_s,
             result.played_s / result.wall_s);
  if (result.trouble.empty()) return lost_rows(out) == 0 ? kDone : kDoneWithLoss;
  fmt::print(stderr, "trivela: {} after {:.1f} s of play; {}\n", result.trouble, result.played_s,
             log.recorded() ? "what was recorded until then is in " + out : "nothing was recorded");
  return kFailed;
}

int record_lockstep(const std::string& feeder, config::Settings settings, int domain, const std::string& out,
                    const WatchFlags* watch) {
  settings = lockstep_settings(std::move(settings), domain, out);
  SignalInbox signals;
  const LogClaim log{out};
  const ConfigFile config{config::to_toml_text(settings)};
  MatchWatch page{watch, settings};
  const MatchResult result = run_match(feeder, config.path(), signals, nodes_of_match(settings));
  const int exit_code = say_how_it_went(result, log, out);
  page.stay_after(result, signals);
  return exit_code;
}

config::Settings with_emulated_devices(config::Settings settings) {
  settings.simulator.devices = config::SimulatedDevices::kEmulated;
  if (std::holds_alternative<config::BusDevice>(settings.hal.kicker)) settings.hal.kicker = config::IoBoardDevice{};
  if (settings.refbox.group.empty()) settings.refbox.group = "224.16.32.39";
  return settings;
}

int record_emulated(config::Settings settings, int domain, const std::string& out, const WatchFlags* watch) {
  settings = match_settings(std::move(settings), domain, out);
  SignalInbox signals;
  const LogClaim log{out};
  const ConfigFile world{config::to_toml_text(settings)};
  std::optional<ConfigFile> robot;
  const auto nodes_config = [&](const std::vector<std::string>& devices) {
    config::override_settings(settings, devices, "the simulator's devices");
    return robot.emplace(config::to_toml_text(settings)).path();
  };
  std::vector<std::string> nodes = nodes_of_match(settings);
  nodes.emplace_back("refbox");
  MatchWatch page{watch, settings};
  const MatchResult result = run_emulated_match(world.path(), nodes_config, signals, nodes);
  const int exit_code = say_how_it_went(result, log, out);
  page.stay_after(result, signals);
  return exit_code;
}

}  // namespace trivela::cli
