#pragma once

#include <cstdint>
#include <optional>
#include <tuple>
#include <variant>

#include "hal/replay/row_pages.hpp"
#include "idl/robot.hpp"

namespace trivela::hal {

/// A recorded sample of a topic that comes from outside the robot's own graph.
using ReplayedSample = std::variant<msg::VisionFrame, msg::FlightFrame, msg::Referee>;

/// What cameras and referee said in a match log, merged by t_ns; of the same instant vision first, then flight camera,
/// then referee.
class ReplayTopics {
 public:
  explicit ReplayTopics(const ReplayLog& log) : topics_(log, log, log) {}

  /// The instant of the next sample; none at the end.
  std::optional<std::int64_t> next_t_ns() const;

  /// The next sample, never waiting; none at the end.
  std::optional<ReplayedSample> next();

  bool ended() const { return !next_t_ns(); }

 private:
  std::tuple<RowPages<msg::VisionFrame>, RowPages<msg::FlightFrame>, RowPages<msg::Referee>> topics_;
};

}  // namespace trivela::hal
