#include "evaluator/calibration/recorded_drives.hpp"

#include <span>

#include "evaluator/log/value.hpp"
#include "evaluator/metrics/ball_sightings.sql.hpp"
#include "evaluator/metrics/drive_kicks.sql.hpp"
#include "evaluator/report/log_sessions.hpp"

namespace trivela::evaluator {

RecordedDrives recorded_drives(const log::Reader& reader) {
  RecordedDrives result;
  SessionBook book;
  const SessionPlaces places = book.add(reader, "");
  book.settle();
  reader.query(kDriveKicksSql, [&](std::span<const log::Value> row) {
    const std::int64_t session = log::integer(row[12]);
    if (!book.counts(places.at(session), static_cast<int>(log::integer(row[13])), log::integer(row[14]))) return;
    result.kicks.push_back({.policy = std::get<std::string>(row[0]),
                            .order_t_ns = std::get<std::int64_t>(row[1]),
                            .pose = {log::number(row[2]), log::number(row[3]), log::number(row[4])},
                            .twist = {log::number(row[5]), log::number(row[6]), log::number(row[7])},
                            .goal_line_y_m = log::number(row[8]),
                            .power = log::number(row[9]),
                            .x_cross_m = log::number_if_any(row[10]),
                            .z_cross_m = log::number_if_any(row[11]),
                            .robot = {std::get<std::int64_t>(row[12]), std::get<std::int64_t>(row[13])}});
  });
  reader.query(kBallSightingsSql, [&](std::span<const log::Value> row) {
    result.sightings[{std::get<std::int64_t>(row[0]), std::get<std::int64_t>(row[1])}].push_back(
        {std::get<std::int64_t>(row[2]), {log::number(row[3]), log::number(row[4]), log::number(row[5])}});
  });
  return result;
}

}  // namespace trivela::evaluator
