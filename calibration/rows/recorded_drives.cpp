#include "calibration/rows/recorded_drives.hpp"

#include <span>

#include "calibration/rows/ball_sightings.sql.hpp"
#include "calibration/rows/drive_kicks.sql.hpp"
#include "evaluator/log/value.hpp"
#include "evaluator/report/log_sessions.hpp"

namespace trivela::calibration {

RecordedDrives recorded_drives(const evaluator::log::Reader& reader) {
  RecordedDrives result;
  evaluator::SessionBook book;
  const evaluator::SessionPlaces places = book.add(reader, "");
  book.settle();
  reader.query(kDriveKicksSql, [&](std::span<const evaluator::log::Value> row) {
    const std::int64_t session = evaluator::log::integer(row[12]);
    if (!book.counts(places.at(session), static_cast<int>(evaluator::log::integer(row[13])),
                     evaluator::log::integer(row[14])))
      return;
    result.kicks.push_back(
        {.policy = std::get<std::string>(row[0]),
         .order_t_ns = std::get<std::int64_t>(row[1]),
         .pose = {evaluator::log::number(row[2]), evaluator::log::number(row[3]), evaluator::log::number(row[4])},
         .twist = {evaluator::log::number(row[5]), evaluator::log::number(row[6]), evaluator::log::number(row[7])},
         .goal_line_y_m = evaluator::log::number(row[8]),
         .power = evaluator::log::number(row[9]),
         .x_cross_m = evaluator::log::number_if_any(row[10]),
         .z_cross_m = evaluator::log::number_if_any(row[11]),
         .robot = {std::get<std::int64_t>(row[12]), std::get<std::int64_t>(row[13])}});
  });
  reader.query(kBallSightingsSql, [&](std::span<const evaluator::log::Value> row) {
    result.sightings[{std::get<std::int64_t>(row[0]), std::get<std::int64_t>(row[1])}].push_back(
        {std::get<std::int64_t>(row[2]),
         {evaluator::log::number(row[3]), evaluator::log::number(row[4]), evaluator::log::number(row[5])}});
  });
  return result;
}

}  // namespace trivela::calibration
