#include "evaluator/render/table.hpp"

#include <fmt/format.h>

namespace trivela::evaluator {

std::string text_of(const Json& cell, const Column& column, const std::string& none) {
  const auto number = [&](const Json& value) {
    return fmt::format(fmt::runtime(column.form), column.scale * value.get<double>());
  };
  if (cell.is_discarded()) return {};
  if (cell.is_null()) return none;
  if (cell.is_string()) return cell.get<std::string>();
  if (!cell.is_object()) return cell.is_number_float() ? number(cell) : cell.dump();
  const Json& ci = cell.at("ci");
  return fmt::format("{} ({})", number(cell.at("value")),
                     ci.is_null() ? "-" : fmt::format("{} to {}", number(ci[0]), number(ci[1])));
}

std::vector<std::vector<std::string>> texts_of(const Table& table, const std::string& none) {
  std::vector<std::vector<std::string>> texts(table.rows.size() + 1);
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const Column& column = table.columns[i];
    if (column.form.empty()) continue;
    texts.front().push_back(column.heading);
    for (std::size_t j = 0; j < table.rows.size(); ++j) texts[j + 1].push_back(text_of(table.rows[j][i], column, none));
  }
  return texts;
}

Json rows_json(const Table& table) {
  return json_list(table.rows, [&](const std::vector<Json>& row) {
    Json json = Json::object();
    for (std::size_t i = 0; i < row.size(); ++i)
      if (const std::string& key = table.columns[i].key; !key.empty() && !row[i].is_discarded())
        json[Json::json_pointer('/' + key)] = row[i];
    return json;
  });
}

}  // namespace trivela::evaluator
