#pragma once

#include <string>
#include <vector>

#include "evaluator/render/json_values.hpp"

namespace trivela::evaluator {

/// A column of a table. People do not see one without a form, programs none without a key.
struct Column {
  std::string key;
  std::string heading{};
  std::string form = "{}";  ///< how people read its numbers
  double scale = 1.0;       ///< what people read is the number times this
};

/// Rows of values under columns with names and units, for people and for programs.
struct Table {
  std::vector<Column> columns;
  std::vector<std::vector<Json>> rows{};
};

/// What people read, the head first, for text_table(), markdown_table() and latex_table(); `none` of null.
std::vector<std::vector<std::string>> texts_of(const Table& table, const std::string& none = "-");

/// [{key: value}].
Json rows_json(const Table& table);

}  // namespace trivela::evaluator
