#pragma once

#include <fmt/format.h>

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "config/text/csv_row.hpp"

namespace trivela::calibration {

/// No field is longer: a distance beyond it was not written in metres.
inline constexpr double kFieldLength_m = 40.0;
// Beyond these a column was measured in another unit.
inline constexpr double kFastestRobot_mps = 10.0;
inline constexpr double kFastestBall_mps = 40.0;
inline constexpr double kFastestTurn_radps = 20.0;
inline constexpr double kHighestCrossing_m = 15.0;
inline constexpr double kWidestCrossing = 3.0;  ///< of the distance to the goal line
inline constexpr double kLongestDelay_s = 1.0;

/// Rows of a measured table, as config::CsvReader reads it.
class NumberTable {
 public:
  /// Reads `file`, "-" for standard input. `columns` names them in order, '-' one to skip; empty: the first line does.
  /// Throws std::runtime_error for a file that cannot be read, is empty, or whose first line names no columns;
  /// config::BadArgument for `columns` that name one twice or none. Sentences on `columns` say `called`.
  static NumberTable read(const std::string& file, const std::string& columns = "",
                          const std::string& called = "columns");

  bool has(std::string_view column) const;

  /// Throws std::runtime_error naming file and columns unless one of them is there.
  void require_one_of(const std::vector<std::string>& columns) const;

  /// Calls `fn` for each row. Throws std::runtime_error naming file, line, column and value of the first bad cell.
  void for_each(const std::function<void(const config::Row&)>& fn) const;

 private:
  std::string file_;
  std::vector<std::string> header_;
  std::vector<config::CsvRecord> records_;
};

}  // namespace trivela::calibration
