#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace trivela::log {

/// What the cells of a column hold: whole numbers, 0 or 1, numbers, one of some labels, any text.
enum class CellKind { kInteger, kTruth, kNumber, kLabel, kText };

struct StreamColumn {
  std::string name;  ///< with its unit
  CellKind kind = CellKind::kInteger;
  bool may_be_null = false;
  std::vector<std::string> labels;  ///< of kLabel, in the order of schema.sql
  std::string meaning;              ///< its comment
};

/// What is recorded of a session by one name.
struct StreamTable {
  std::string name;
  std::string key;      ///< columns of its primary key, "session_id, robot_id, seq"
  std::string meaning;  ///< its comment
  std::vector<StreamColumn> columns;

  /// Its rows belong each to a robot and are numbered.
  bool is_of_robots() const { return key == "session_id, robot_id, seq"; }

  bool has(std::string_view column) const;
};

/// The tables of a match log that have a session's rows, without its digest, in the order of schema.sql: their columns
/// are read out of that text, so that a new one is here by itself.
const std::vector<StreamTable>& stream_tables();

}  // namespace trivela::log
