#include "hal/replay/replay_log.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

namespace trivela::hal {

void require_lockstep(const evaluator::log::Session& session, const std::filesystem::path& file) {
  if (session.simulated_clock) return;
  throw std::runtime_error{fmt::format(
      "{}: recorded in real time, where every stream has instants of its own; only a log of a lockstep match "
      "can be replayed through the nodes",
      file.string())};
}

ReplayLog ReplayLog::open(const std::filesystem::path& file, int robot_id, std::optional<std::int64_t> session_id) {
  auto reader = std::make_shared<const evaluator::log::Reader>(file);
  const auto sessions = reader->sessions();
  if (!session_id) {
    if (sessions.size() != 1) {
      throw std::runtime_error{
          fmt::format("{}: holds {} sessions; name the one to replay", file.string(), sessions.size())};
    }
    return {std::move(reader), sessions.front().session_id, robot_id};
  }
  const bool known = std::any_of(sessions.begin(), sessions.end(),
                                 [&](const auto& session) { return session.session_id == *session_id; });
  if (!known) throw std::runtime_error{fmt::format("{}: holds no session {}", file.string(), *session_id)};
  return {std::move(reader), *session_id, robot_id};
}

}  // namespace trivela::hal
