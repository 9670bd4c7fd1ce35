#include "nodes/recorder/log_place.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <functional>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "nodes/recorder/recorder_node.hpp"
#include "robot/recording/log_family.hpp"

namespace trivela::nodes {
namespace {

namespace fs = std::filesystem;
using log::Session;
using log::Writer;

// Where a log goes whose own folder refuses: the last one is memory, gone when the machine is switched off. A service
// has its state folder ($STATE_DIRECTORY, of systemd); its /tmp and /var/tmp may be its own and go with it
// (PrivateTmp=).
std::vector<fs::path> other_folders() {
  std::vector<fs::path> folders;
  if (const char* const states = std::getenv("STATE_DIRECTORY")) {
    std::istringstream list{states};
    for (std::string folder; std::getline(list, folder, ':');)
      if (!folder.empty()) folders.emplace_back(folder);
  }
  std::error_code none;
  if (folders.empty()) folders = {fs::temp_directory_path(none), "/var/tmp"};
  folders.emplace_back("/dev/shm");
  return folders;
}

// Names to try after the configured one, in this order.
std::vector<fs::path> further_names(const fs::path& log, std::uint32_t robot_id, std::int64_t now_utc_ns) {
  const std::string time = robot::log_time(now_utc_ns);
  std::string stem = log.stem().string();
  if (stem.find(time) == std::string::npos) stem += fmt::format("-r{}-{}", robot_id, time);
  const std::string ending = log.extension().string();
  std::vector<fs::path> folders = other_folders();
  folders.insert(folders.begin(), log.parent_path());
  std::vector<fs::path> names;
  for (const fs::path& folder : folders) {
    names.push_back(folder / (stem + ending));
    for (int n = 2; n <= 9; ++n) names.push_back(folder / fmt::format("{}-{}{}", stem, n, ending));
  }
  return names;
}

// The session that this one goes on from, where the log's folder is gone from those that stand in for it.
std::optional<robot::Predecessor> predecessor(const fs::path& log, const robot::LogFamily& family,
                                              const Session& session, std::int64_t now_utc_ns,
                                              const std::function<void(const std::string&)>& warn) {
  std::error_code none;
  const fs::path folder = log.has_parent_path() ? log.parent_path() : fs::path{"."};
  if (fs::is_directory(folder, none)) return robot::find_predecessor(folder, family, session, now_utc_ns, warn);
  for (const fs::path& other : other_folders()) {
    if (auto found = robot::find_predecessor(other, family, session, now_utc_ns, warn)) return found;
  }
  return std::nullopt;
}

bool holds_anything(const fs::path& path) {
  std::error_code none;
  const auto size = fs::file_size(path, none);
  return fs::exists(path, none) && (none || size > 0);
}

}  // namespace

PlacedLog place_log(const NodeContext& context, const log::WriterOptions& options) {
  const config::Settings& settings = context.settings;
  const std::int64_t now_utc_ns = now_ns(std::chrono::system_clock::now());
  const robot::LogNaming naming{settings.run.team, settings.run.robot_id, now_utc_ns};
  const fs::path log = robot::log_path(settings.recorder.log, naming);
  Session session = session_of(context);
  if (settings.run.lockstep) return {log, std::make_unique<Writer>(log, session, options)};
  const auto warn = [&](const std::string& line) { context.logger->warn("{}", line); };
  const robot::LogFamily family = robot::log_family(settings.recorder.log, naming);
  if (const auto before = predecessor(log, family, session, now_utc_ns, warn)) {
    session.continues_uuid = before->uuid;
    session.continued = before->drivers;
    warn(fmt::format("this session goes on from {} in {}", before->uuid, before->log.string()));
  }
  std::vector<fs::path> names = further_names(log, settings.run.robot_id, now_utc_ns);
  names.insert(names.begin(), log);
  std::string reasons;
  for (const fs::path& name : names) {
    if (name != log && holds_anything(name)) continue;
    try {
      auto writer = std::make_unique<Writer>(name, session, options);
      if (name != log) context.logger->error("recording to {}, since {}", name.string(), reasons);
      return {name, std::move(writer)};
    } catch (const std::runtime_error& error) {
      if (name == log || name.parent_path() != log.parent_path() || reasons.empty()) {
        reasons += (reasons.empty() ? "" : "; ") + std::string{error.what()};
      }
    }
  }
  throw std::runtime_error{reasons};
}

}  // namespace trivela::nodes
