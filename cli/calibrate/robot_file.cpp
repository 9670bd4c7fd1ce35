#include "cli/calibrate/robot_file.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>

#include "cli/verbs.hpp"
#include "config/text/installation.hpp"

namespace trivela::cli {
namespace {

namespace fs = std::filesystem;

bool plain(const std::string& name) {
  const auto allowed = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; };
  return !name.empty() && name.front() != '-' && std::ranges::all_of(name, allowed);
}

}  // namespace

std::string today() { return fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr))); }

fs::path find_robot(const std::string& name_or_file) {
  if (name_or_file.find('/') != std::string::npos || name_or_file.ends_with(".toml")) return name_or_file;
  const std::string file = name_or_file + ".toml";
  for (const fs::path& path : {fs::path("config/robots") / file, fs::path(file), config::shipped("robots") / file}) {
    if (fs::is_regular_file(path)) return path;
  }
  throw std::runtime_error(fmt::format("no robot {}: neither config/robots/{} nor {} nor {}", name_or_file, file, file,
                                       (config::shipped("robots") / file).string()));
}

fs::path robot_target(const std::string& name, const std::string& out) {
  if (!plain(name)) {
    throw UsageError(fmt::format("--robot '{}': a name of letters, digits, '_' and '-', such as cambada_7", name));
  }
  if (!out.empty()) return out;
  const fs::path robots = "config/robots";
  return fs::is_directory(robots) ? robots / (name + ".toml") : fs::path(name + ".toml");
}

config::Robot robot_to_calibrate(const std::string& name, const fs::path& target, const std::string& start) {
  if (fs::exists(target)) {
    if (!start.empty()) {
      throw UsageError(fmt::format("--base goes with a new robot, but {} exists already", target.string()));
    }
    config::Robot robot = config::load_robot_of_any_table(target);
    if (robot.name != name) {
      throw UsageError(fmt::format("{} is of robot '{}', not of '{}'", target.string(), robot.name, name));
    }
    return robot;
  }
  const fs::path from = start.empty() ? config::shipped("robots/cambada_1.toml") : find_robot(start);
  config::Robot robot = config::load_robot_of_any_table(from);
  robot.source = fmt::format("calibrated; what [calibration] does not name comes from: {}", robot.source);
  robot.name = name;
  robot.calibration.reset();  // another robot's
  return robot;
}

}  // namespace trivela::cli
