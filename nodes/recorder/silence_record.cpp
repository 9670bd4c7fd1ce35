#include "nodes/recorder/silence_record.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "kicking/geometry/time.hpp"

namespace trivela::nodes {

std::size_t SilenceRecord::add(const std::string& table, double period_s) {
  const double longest_s = std::max(period_s, cycle_s_);
  const std::lock_guard lock{mutex_};
  const auto known = std::ranges::find(tables_, table);
  if (known != tables_.end()) return static_cast<std::size_t>(known - tables_.begin());
  tables_.push_back(table);
  return watch_.add(kicking::nanoseconds(longest_s));
}

void SilenceRecord::heard(std::size_t stream, std::uint8_t robot_id, std::int64_t t_ns) {
  if (robot_id == 0) return;  // there is no such robot; in the log it stands for all of them
  const std::lock_guard lock{mutex_};
  watch_.heard(stream, robot_id, t_ns);
}

void SilenceRecord::look(std::int64_t now_ns) {
  const std::lock_guard lock{mutex_};
  for (const robot::SilenceEdge& edge : watch_.look(now_ns)) {
    write(edge);
    lines_.note(edge, fmt::format("{} of robot {}", tables_[edge.stream], edge.robot_id));
  }
  for (const std::string& line : lines_.due(now_ns)) logger_->warn("{}", line);
}

void SilenceRecord::write(const robot::SilenceEdge& edge) {
  const log::Silence silence{tables_[edge.stream], edge.robot_id, edge.from_ns, edge.to_ns};
  if (edge.was_delay()) {
    log_.withdraw(silence);
  } else {
    log_.silence(silence);
  }
}

}  // namespace trivela::nodes
