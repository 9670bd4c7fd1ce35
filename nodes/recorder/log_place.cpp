#include "nodes/recorder/log_place.hpp"

#include <fmt/chrono.h>

#include <stdexcept>

#include "nodes/recorder/recorder_node.hpp"
#include "nodes/runtime/node_context.hpp"
#include "robot/recording/predecessor.hpp"

namespace trivela::nodes {
namespace {

namespace fs = std::filesystem;
using evaluator::log::Session;
using evaluator::log::Writer;

// Names to try after the configured one, in this order.
std::vector<fs::path> further_names(const fs::path& log, std::uint32_t robot_id, std::int64_t now_utc_ns) {
  const std::time_t now_s = now_utc_ns / 1'000'000'000;
  const std::string stem = fmt::format("{}-r{}-{:%Y%m%dT%H%M%SZ}", log.stem().string(), robot_id, fmt::gmtime(now_s));
  const std::string ending = log.extension().string();
  std::error_code none;
  std::vector<fs::path> names;
  for (const fs::path& folder : {log.parent_path(), fs::temp_directory_path(none)}) {
    names.push_back(folder / (stem + ending));
    for (int n = 2; n <= 9; ++n) names.push_back(folder / fmt::format("{}-{}{}", stem, n, ending));
  }
  return names;
}

bool holds_anything(const fs::path& path) {
  std::error_code none;
  const auto size = fs::file_size(path, none);
  return fs::exists(path, none) && (none || size > 0);
}

}  // namespace

PlacedLog place_log(const NodeContext& context, const evaluator::log::WriterOptions& options) {
  const fs::path log = context.settings.recorder.log;
  Session session = session_of(context);
  if (context.settings.run.lockstep) return {log, std::make_unique<Writer>(log, session, options)};
  const auto warn = [&](const std::string& line) { context.logger->warn("{}", line); };
  const std::int64_t now_utc_ns = now_ns(std::chrono::system_clock::now());
  if (const auto before = robot::find_predecessor(log, session, now_utc_ns, warn)) {
    session.continues_uuid = before->uuid;
    session.continued = before->drivers;
    warn(fmt::format("this session goes on from {} in {}", before->uuid, before->log.string()));
  }
  std::vector<fs::path> names = further_names(log, context.settings.run.robot_id, now_utc_ns);
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
