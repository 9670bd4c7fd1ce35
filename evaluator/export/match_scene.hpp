#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "evaluator/mcap/messages.hpp"
#include "evaluator/sessions/session_facts.hpp"
#include "log/read/stream_table.hpp"
#include "log/schema/row.hpp"

namespace trivela::evaluator {

/// Puts a message that lies in a Cdr on a topic: its name, its standard type.
using PutMessage = std::function<void(const std::string& topic, std::string_view type)>;

/// Columns of a table by their names.
class Places {
 public:
  explicit Places(const log::StreamTable& table);
  std::size_t operator[](std::string_view column) const;

 private:
  std::map<std::string, std::size_t, std::less<>> places_;
};

/// What is seen of a match in a 3D view, as standard messages of ROS in the frame "field" (F: x to the right, y to the
/// opponents' goal). A robot's frame is that of REP 103, x forward, y to the left: its yaw is the heading and a quarter
/// turn. Topics of a robot: `pose`, `ball`, `alignment` (both segments), `crossings`; `tf` and `field` of all.
class MatchScene {
 public:
  explicit MatchScene(mcap::Cdr& cdr) : cdr_(cdr) {}

  /// Lines of the field and the goal, on `topic`.
  void put_field(const LoggedPitch& pitch, std::int64_t t_ns, const std::string& topic, const PutMessage& put);

  /// What a row shows, on topics that begin with `prefix`; most tables show nothing.
  void put_row(const log::StreamTable& table, const Places& at, std::span<const log::Value> row, std::int64_t t_ns,
               double goal_y_m, const std::string& prefix, const std::string& robot, const PutMessage& put);

 private:
  mcap::Cdr& cdr_;
};

}  // namespace trivela::evaluator
