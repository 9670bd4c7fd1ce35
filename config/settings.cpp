#include "config/settings.hpp"

#include <fmt/core.h>

#include "config/settings_fields.hpp"
#include "config/toml_source.hpp"
#include "config/toml_text.hpp"

namespace trivela::config {
namespace {

void make_relative_to(const std::filesystem::path& folder, std::string& file) {
  if (!file.empty() && std::filesystem::path{file}.is_relative()) file = (folder / file).string();
}

}  // namespace

Settings load_settings(const std::filesystem::path& path) {
  Settings settings;
  const TomlSource source = parse_file(path);
  read_into(source, settings);
  if (settings.kick_decision.policy_by_half.empty()) {
    throw Error{fmt::format("{}: kick_decision.policy_by_half is empty: name at least one policy", source.file)};
  }
  settings.policy.cycle_s = settings.run.cycle_s;
  const std::filesystem::path folder = path.parent_path();
  make_relative_to(folder, settings.run.robot);
  make_relative_to(folder, settings.run.scenario);
  make_relative_to(folder, settings.domain.dds_file);
  make_relative_to(folder, settings.hal.replay_log);
  return settings;
}

void override_setting(Settings& settings, const std::string& line) { read_into(parse_text(line, "--set"), settings); }

std::string to_toml_text(const Settings& settings) { return to_toml(settings); }

}  // namespace trivela::config
