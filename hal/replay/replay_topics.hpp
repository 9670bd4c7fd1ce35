#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <variant>

#include "hal/replay/row_pages.hpp"
#include "sim/sensors.hpp"

namespace trivela::hal {

/// A recorded sample of a topic that comes from outside the robot's own graph.
struct ReplayedSample {
  std::int64_t seq = 0;
  std::int64_t t_ns = 0;
  std::variant<sim::VisionFrame, sim::FlightFrame, sim::RefereeWord> what;
};

/// What cameras and referee said in a match log (tables vision_frames, flight_frames, referee), merged by t_ns; of the
/// same instant vision first, then flight camera, then referee.
class ReplayTopics {
 public:
  explicit ReplayTopics(const ReplayLog& log);

  /// The instant of the next sample; none at the end.
  std::optional<std::int64_t> next_t_ns() const;

  /// The next sample, never waiting; none at the end.
  std::optional<ReplayedSample> next();

  bool ended() const { return !next_t_ns(); }

 private:
  std::optional<std::size_t> next_table() const;

  std::array<RowPages, 3> tables_;
};

}  // namespace trivela::hal
