#include <fmt/core.h>

#include "calibration/scanner_session.hpp"
#include "cli/options/number_checks.hpp"
#include "cli/scan/verb_parts.hpp"
#include "cli/verbs.hpp"

namespace trivela::cli {
namespace {

struct ScanFlags {
  std::string synthesize;
  std::string record;
  std::string info;
  EmulateFlags emulate;
  SyntheticFlags synthetic;
  MountFlags mount;
  std::string truth;
  std::string device;
  std::optional<double> seconds;
  std::optional<double> power;
  int tcp = 0;
  bool pty = false;
  bool json = false;
};

void add_modes(CLI::App& verb, ScanFlags& flags) {
  auto* modes = verb.add_option_group("modes", "exactly one of");
  modes->add_option("--synthesize", flags.synthesize, "make a synthetic scan record; must not exist");
  modes->add_option("--record", flags.record, "record a scanner to this file, must not exist; needs --device");
  modes->add_option("--emulate", flags.emulate.source, "play a scan record, or `synthetic` scans, as a SCIP scanner");
  modes->add_option("--info", flags.info, "what a scan record holds");
  modes->require_option(1);
}

void add_synthetic_flags(CLI::App& verb, SyntheticFlags& flags) {
  add_default(verb, "--seed", flags.seed, "synthetic: same seed, same scans", seeds());
  auto* speeds = verb.add_option("--exit-speed-mps", flags.exit_speed_mps, "synthetic: true speeds of the kicks")
                     ->delimiter(',')
                     ->check(CLI::Range(1.0, 30.0));
  verb.add_option("--set-points", flags.set_points, "synthetic: powers and speeds of this robot file")
      ->excludes(speeds);
  add_default(verb, "--lobs", flags.lobs, "synthetic: kicks of each speed", CLI::Range(0, 1000));
  add_default(verb, "--exit-angle-deg", flags.exit_angle_deg, "synthetic: true angle over the floor",
              CLI::Range(1.0, 85.0));
  add_default(verb, "--cd", flags.cd, "synthetic: drag coefficient", CLI::Range(0.0, 2.0));
  const auto spread = [&](const char* name, double& value, double most, const char* help) {
    add_default(verb, name, value, help, CLI::Range(0.0, most));
  };
  spread("--speed-sd-mps", flags.speed_sd_mps, 1.0, "synthetic: spread of the kicker's speed");
  spread("--angle-sd-deg", flags.angle_sd_deg, 10.0, "synthetic: spread of the kicker's angle");
  spread("--range-sd-m", flags.range_sd_m, 0.5, "synthetic: noise of a range");
  spread("--dropout-ratio", flags.dropout_ratio, 1.0, "synthetic: beams without an answer");
  spread("--mixed-ratio", flags.mixed_ratio, 1.0, "synthetic: edges of the ball that read something behind it");
  add_default(verb, "--scanner", flags.scanner, "synthetic: utm-30lx or urg-04lx",
              CLI::IsMember({"utm-30lx", "urg-04lx"}));
}

int run(const ScanFlags& flags) {
  if (!flags.info.empty()) return show_scan_info(flags.info, flags.json);
  if (!flags.synthesize.empty()) {
    calibration::refuse_existing(flags.synthesize);
    return write_synthetic(synthesize(flags.synthetic, flags.mount), flags.synthesize, flags.truth);
  }
  if (!flags.record.empty()) {
    if (flags.device.empty()) throw UsageError{"--record needs --device DEVICE or --device tcp://HOST:PORT"};
    return record_scans(flags.record, flags.device, flags.mount, flags.seconds, flags.power);
  }
  EmulateFlags emulate = flags.emulate;
  if (!flags.pty) emulate.tcp_port = flags.tcp;
  return emulate_scanner(emulate, flags.synthetic, flags.mount);
}

}  // namespace

void add_scan(CLI::App& app, int& exit_code) {
  const auto [verb, flags] =
      add_verb(app, exit_code, "scan", "Record a laser range finder, emulate one, or make synthetic scans", run);
  verb->footer(
      fmt::format("Made scans are {}.\n"
                  "--emulate prints the address to connect to and plays until Ctrl-C.",
                  kSyntheticNotice));
  add_modes(*verb, *flags);
  verb->add_option("--device", flags->device, "record: /dev/ttyACM0, or tcp://HOST:PORT");
  verb->add_option("--seconds", flags->seconds, "record: so long; default: until Ctrl-C")->check(above_zero());
  verb->add_option("--power", flags->power, "record: set-point of the kicks")->check(above_zero());
  auto* tcp =
      add_default(*verb, "--tcp", flags->tcp, "emulate: port on the loopback interface, 0: any", CLI::Range(0, 65535));
  verb->add_flag("--pty", flags->pty, "emulate: on a pseudo-terminal")->excludes(tcp);
  add_default(*verb, "--speed", flags->emulate.speed, "emulate: so many times real time", CLI::Range(0.01, 100.0));
  verb->add_flag("--loop", flags->emulate.loop, "emulate: begin again at the end");
  verb->add_flag("--json", flags->json, "info: as JSON");
  verb->add_option("--truth", flags->truth, "synthesize: CSV for what was really kicked");
  add_synthetic_flags(*verb, flags->synthetic);
  add_mount_flags(*verb, flags->mount);
}

}  // namespace trivela::cli
