#pragma once

#include <span>

#include "evaluator/mcap/cdr.hpp"
#include "evaluator/mcap/mcap_writer.hpp"
#include "log/read/stream_table.hpp"
#include "log/schema/row.hpp"

namespace trivela::evaluator::mcap {

/// Label of an enum that its column does not know.
inline constexpr std::uint8_t kOtherLabel = 255;

/// The message that a row of a table becomes: trivela_msgs/msg/KickDecision of kick_decisions. A member a column, by
/// its name and in the order of schema.sql: int64, float64 (NULL: NaN), bool, string, and uint8 of labels, whose
/// constants stand before it. Before any but a float64 that may be NULL stands bool has_NAME.
Schema schema_of(const log::StreamTable& table);

/// The row in CDR. Throws log::WrongCell where a cell is not what its column holds.
void write_row(Cdr& cdr, const log::StreamTable& table, std::span<const log::Value> row);

}  // namespace trivela::evaluator::mcap
