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

/// What people read of a value, `none` of null. A value with its interval, {"value": v, "ci": [lo, hi]}:
/// "87.8 (87.1 to 88.5)", or "87.8 (-)" where "ci" is null. Nothing of a discarded one, which its row does not have.
std::string text_of(const Json& cell, const Column& column, const std::string& none = "-");

/// Rows of values under columns with names and units, for people and for programs.
struct Table {
  std::vector<Column> columns;
  std::vector<std::vector<Json>> rows{};
};

/// What people read, the head first, for text_table(), markdown_table() and latex_table(); `none` of null.
std::vector<std::vector<std::string>> texts_of(const Table& table, const std::string& none = "-");

/// [{key: value}]. A key "a/b" is key b of the object a.
Json rows_json(const Table& table);

}  // namespace trivela::evaluator
