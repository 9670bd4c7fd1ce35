#include "hal/replay/replay_topics.hpp"

namespace trivela::hal {
namespace {

std::optional<sim::PlanPoint> point(const ReplayRow& row, std::size_t column) {
  const auto x = row.number(column), y = row.number(column + 1);
  if (!x || !y) return std::nullopt;
  return sim::PlanPoint{*x, *y};
}

// Columns 0 and 1 are seq and t_ns; a sample's own follow.

sim::VisionFrame vision(const ReplayRow& row) {
  sim::VisionFrame frame{.t_exposure_ns = row.integer(2), .pose = {}, .ball = {}, .opponent = {}};
  const auto x = row.number(4), y = row.number(5), heading = row.number(6);
  if (row.boolean(3) && x && y && heading) frame.pose = kicking::Pose{*x, *y, *heading};
  if (row.boolean(7)) frame.ball = point(row, 8);
  if (row.boolean(10)) frame.opponent = point(row, 11);
  return frame;
}

sim::FlightFrame flight(const ReplayRow& row) {
  sim::FlightFrame frame{.t_exposure_ns = row.integer(2), .ball = {}};
  const auto x = row.number(4), y = row.number(5), z = row.number(6);
  if (row.boolean(3) && x && y && z) frame.ball = sim::FlightFrame::Point{*x, *y, *z};
  return frame;
}

sim::RefereeWord referee(const ReplayRow& row) {
  return {.half = static_cast<int>(row.integer(2)),
          .playing = row.boolean(3),
          .possession_id = static_cast<std::uint32_t>(row.integer(4))};
}

}  // namespace

ReplayTopics::ReplayTopics(const ReplayLog& log)
    : tables_{
          RowPages{log,
                   "vision_frames",
                   {"seq", "t_ns", "t_exposure_ns", "pose_seen", "x_m", "y_m", "heading_rad", "ball_seen", "ball_x_m",
                    "ball_y_m", "opponent_seen", "opponent_x_m", "opponent_y_m"}},
          RowPages{
              log, "flight_frames", {"seq", "t_ns", "t_exposure_ns", "ball_seen", "ball_x_m", "ball_y_m", "ball_z_m"}},
          RowPages{log, "referee", {"seq", "t_ns", "half", "playing", "possession_id"}}} {}

std::optional<std::size_t> ReplayTopics::next_table() const {
  std::optional<std::size_t> earliest;
  for (std::size_t i = 0; i < tables_.size(); ++i) {
    const ReplayRow* row = tables_[i].peek();
    if (row && (!earliest || row->integer(1) < tables_[*earliest].peek()->integer(1))) earliest = i;
  }
  return earliest;
}

std::optional<std::int64_t> ReplayTopics::next_t_ns() const {
  const auto table = next_table();
  if (!table) return std::nullopt;
  return tables_[*table].peek()->integer(1);
}

std::optional<ReplayedSample> ReplayTopics::next() {
  const auto table = next_table();
  if (!table) return std::nullopt;
  const ReplayRow row = *tables_[*table].next();
  ReplayedSample sample{.seq = row.integer(0), .t_ns = row.integer(1), .what = {}};
  if (*table == 0) sample.what = vision(row);
  if (*table == 1) sample.what = flight(row);
  if (*table == 2) sample.what = referee(row);
  return sample;
}

}  // namespace trivela::hal
