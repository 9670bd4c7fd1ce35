#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

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

}  // namespace trivela::evaluator
