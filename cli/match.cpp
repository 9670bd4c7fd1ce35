#include <fmt/core.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "cli/launch/match_run.hpp"
#include "cli/verbs.hpp"
#include "config/robot.hpp"
#include "config/scenario.hpp"
#include "config/settings.hpp"

namespace trivela::cli {
namespace {

namespace fs = std::filesystem;

struct MatchFlags {
  std::vector<std::string> halves;
  double minutes = 5.0;
  std::int64_t seed = 1;
  int domain = -1;
  std::string out = "match.db";
  std::string config = TRIVELA_CONFIG_DIR "/default.toml";
  std::vector<std::string> overrides;
  std::string log_level = "warn";
};

/// The configuration of one match in a file of its own, gone with the object.
class MatchConfigFile {
 public:
  explicit MatchConfigFile(const config::Settings& settings) {
    std::string name = (fs::temp_directory_path() / "trivela-match-XXXXXX.toml").string();
    const int descriptor = mkstemps(name.data(), 5);
    if (descriptor < 0) throw std::runtime_error{fmt::format("cannot write the match's configuration to {}", name)};
    close(descriptor);
    path_ = name;
    std::ofstream{path_} << config::to_toml_text(settings);
  }
  MatchConfigFile(const MatchConfigFile&) = delete;
  MatchConfigFile& operator=(const MatchConfigFile&) = delete;
  ~MatchConfigFile() { fs::remove(path_); }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// Lines such as `kick_decision.policy_by_half = ["stopped", "moving"]`: the checks of the configuration are the flags'
/// too.
config::Settings settings_of(const MatchFlags& flags) {
  config::Settings settings = config::load_settings(flags.config);
  std::string halves;
  for (const std::string& half : flags.halves) halves += fmt::format("{}\"{}\"", halves.empty() ? "" : ", ", half);
  std::vector<std::string> lines{fmt::format("kick_decision.policy_by_half = [{}]", halves),
                                 fmt::format("simulator.halves = {}", flags.halves.size()),
                                 fmt::format("simulator.half_minutes = {:.17e}", flags.minutes),
                                 fmt::format("simulator.seed = {}", flags.seed),
                                 fmt::format("run.log_level = \"{}\"", flags.log_level)};
  for (const std::string& line : flags.overrides) lines.push_back(line);
  for (const std::string& line : lines) config::override_setting(settings, line);
  // Matches at the same time hear each other in neither domain nor tag.
  std::random_device random;
  settings.domain.domain_id = flags.domain >= 0 ? static_cast<std::uint32_t>(flags.domain) : 1 + random() % 100;
  settings.domain.tag = fmt::format("match-{}-{:08x}", getpid(), random());
  settings.run.lockstep = true;
  settings.recorder.log = fs::absolute(flags.out).string();
  settings.run.robot = fs::absolute(settings.run.robot).string();
  settings.run.scenario = fs::absolute(settings.run.scenario).string();
  config::load_scenario(settings.run.scenario);
  config::load_robot(settings.run.robot);
  return settings;
}

int play(const MatchFlags& flags) {
  if (fs::exists(flags.out)) {
    throw UsageError{
        fmt::format("{} exists already; a recorded match is never overwritten, choose another --out", flags.out)};
  }
  const MatchConfigFile file{settings_of(flags)};
  const fs::path programs = fs::read_symlink("/proc/self/exe").parent_path();
  const MatchResult result = run_match(programs, file.path());
  fmt::print("played {:.0f} s in {:.1f} s: {:.1f} times real time\n", result.played_s, result.wall_s,
             result.played_s / result.wall_s);
  if (result.trouble.empty()) return kDone;
  fmt::print(stderr, "trivela match: {} after {:.1f} s of play; what was recorded until then is in {}\n",
             result.trouble, result.played_s, flags.out);
  return kFailed;
}

}  // namespace

void add_match(CLI::App& app, int& exit_code) {
  auto* verb = app.add_subcommand("match", "play a simulated match with real node processes and record it");
  auto flags = std::make_shared<MatchFlags>();
  verb->add_option("--half", flags->halves, "policy in charge of a half, one --half each: stopped or moving")
      ->required()
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  verb->add_option("--minutes", flags->minutes, "length of a half")->capture_default_str();
  verb->add_option("--seed", flags->seed, "same seed, same match")->capture_default_str();
  verb->add_option("--domain", flags->domain, "DDS domain; default: drawn, with a discovery tag of its own")
      ->check(CLI::Range(0, 100));
  verb->add_option("--out", flags->out, "match log, must not exist")->capture_default_str();
  verb->add_option("--config", flags->config, "configuration of the nodes")->capture_default_str();
  verb->add_option("--set", flags->overrides, "one setting on top, e.g. --set policy.settle_s=0.5");
  verb->add_option("--log-level", flags->log_level, "of the nodes: trace, debug, info, warn, error, off")
      ->capture_default_str();
  verb->callback([flags, &exit_code] { exit_code = play(*flags); });
}

}  // namespace trivela::cli
