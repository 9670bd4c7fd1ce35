#include "cli/launch/record_emulated.hpp"

#include <optional>

#include "cli/launch/config_file.hpp"
#include "cli/launch/log_claim.hpp"
#include "cli/launch/match_run.hpp"
#include "cli/launch/record_lockstep.hpp"
#include "cli/watch/match_watch.hpp"

namespace trivela::cli {

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
  std::optional<ConfigFile> nodes;
  const auto nodes_config = [&](const std::vector<std::string>& devices) {
    config::override_settings(settings, devices, "the simulator's devices");
    return nodes.emplace(config::to_toml_text(settings)).path();
  };
  std::vector<std::string> beside = more_nodes(settings);
  beside.emplace_back("refbox");
  MatchWatch page{watch, settings};
  const MatchResult result = run_emulated_match(world.path(), nodes_config, signals, beside);
  const int exit_code = say_how_it_went(result, log, out);
  page.stay_after(result, signals);
  return exit_code;
}

}  // namespace trivela::cli
