#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "evaluator/sessions/same_match.hpp"
#include "kicking/geometry/time.hpp"
#include "log/read/reader.hpp"

namespace trivela::evaluator {

/// A stream of a robot that said nothing for more than three of its periods.
struct RecordedSilence : log::Silence {
  std::int64_t session_id = 0;
  std::int64_t started_t_ns = 0;  ///< of the session
  bool counts = false;            ///< it ended, or other streams of the robot went on for more than a second

  double from_s() const { return kicking::seconds(from_t_ns - started_t_ns); }
  std::optional<double> to_s() const;
};

/// What a kicker's driver did by its own count and the log knows nothing of.
struct UnrecordedOrders {
  std::int64_t session_id = 0;
  int robot_id = 0;
  bool continues = false;          ///< the session goes on from another
  bool restarted_before = false;   ///< the driver was started again between the two: there may be more
  std::int64_t orders_before = 0;  ///< before the session; where it continues another: since that one's end
  std::int64_t kicks_before = 0;
  std::int64_t orders_within = 0;
  std::int64_t kicks_within = 0;

  /// Kicks of the match stand in no log, or may. What came before a session that continues none may be another match.
  bool counts() const { return kicks_within > 0 || (continues && (kicks_before > 0 || restarted_before)); }
};

std::vector<RecordedSilence> silences_of(const log::Reader& reader);
std::vector<UnrecordedOrders> unrecorded_orders_of(const log::Reader& reader);

/// A sentence a silence; of many the first ones and how many more there are.
std::vector<std::string> silence_lines(const std::vector<RecordedSilence>& silences);

/// A sentence for each place where orders are missing.
std::vector<std::string> order_lines(const std::vector<UnrecordedOrders>& orders);

/// How long a match was to last, and how much of it is in the log; of several recordings together.
struct PlayedLength {
  std::int64_t session_id = 0;  ///< of the first recording
  double planned_s = 0.0;
  double recorded_s = 0.0;    ///< between words of the referee, stops included
  bool half_missing = false;  ///< one of the planned halves, all as long, is not there or ends early

  /// Less than was planned, all of it or of a half: a half that lasts until its last possession has ended makes up for
  /// none of the next. The last cycle may end half a second early.
  bool cut_short() const { return half_missing || recorded_s < planned_s - 0.5; }
};

/// Of every match whose length was planned (sessions.planned_s), in the order of `sessions`.
std::vector<PlayedLength> played_lengths(std::span<const log::Reader* const> logs,
                                         const std::vector<ComparedSession>& sessions);

/// "cut short: 27.0 s of 300.0 s are recorded"; one a match that was.
std::vector<std::string> cut_short_lines(const std::vector<PlayedLength>& lengths);

}  // namespace trivela::evaluator
