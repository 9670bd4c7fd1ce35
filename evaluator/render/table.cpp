#include "evaluator/render/table.hpp"

#include <fmt/format.h>

namespace trivela::evaluator {

std::vector<std::vector<std::string>> texts_of(const Table& table, const std::string& none) {
  std::vector<std::vector<std::string>> texts(table.rows.size() + 1);
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const Column& column = table.columns[i];
    if (column.form.empty()) continue;
    texts.front().push_back(column.heading);
    for (std::size_t j = 0; j < table.rows.size(); ++j) {
      const Json& cell = table.rows[j][i];
      texts[j + 1].push_back(cell.is_number_float()
                                 ? fmt::format(fmt::runtime(column.form), column.scale * cell.get<double>())
                             : cell.is_string() ? cell.get<std::string>()
                             : cell.is_null()   ? none
                                                : cell.dump());
    }
  }
  return texts;
}

Json rows_json(const Table& table) {
  return json_list(table.rows, [&](const std::vector<Json>& row) {
    Json json = Json::object();
    for (std::size_t i = 0; i < row.size(); ++i)
      if (!table.columns[i].key.empty()) json[table.columns[i].key] = row[i];
    return json;
  });
}

}  // namespace trivela::evaluator
