#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "evaluator/log/reader.hpp"

namespace trivela::hal {

/// Throws std::runtime_error naming the file where the session was not recorded in lockstep.
void require_lockstep(const evaluator::log::Session& session, const std::filesystem::path& file);

/// One robot's part of one session in a match log.
struct ReplayLog {
  std::shared_ptr<const evaluator::log::Reader> reader;
  std::int64_t session_id = 0;
  int robot_id = 0;

  /// Opens the log. Without a session it must hold one only. Throws std::runtime_error naming the file where it cannot
  /// be read, holds no such session, or several to choose from.
  static ReplayLog open(const std::filesystem::path& file, int robot_id, std::optional<std::int64_t> session_id = {});
};

}  // namespace trivela::hal
