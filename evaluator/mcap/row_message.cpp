#include "evaluator/mcap/row_message.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <limits>

#include "log/schema/queries.hpp"

namespace trivela::evaluator::mcap {
namespace {

using log::CellKind;
using log::StreamColumn;

const char* type_of(CellKind kind) {
  switch (kind) {
    case CellKind::kInteger:
      return "int64";
    case CellKind::kTruth:
      return "bool";
    case CellKind::kNumber:
      return "float64";
    case CellKind::kLabel:
      return "uint8";
    default:
      return "string";
  }
}

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

/// Of a table's name in the plural: "kick_decision", "session_policy", "loss"; "kicker_status" is none.
std::string singular(std::string name) {
  const auto drop = [&](std::size_t n) { name.resize(name.size() - n); };
  if (name.ends_with("ies")) {
    drop(3);
    name += 'y';
  } else if (name.ends_with("sses")) {
    drop(2);
  } else if (name.ends_with("s") && !name.ends_with("us") && !name.ends_with("ss")) {
    drop(1);
  }
  return name;
}

std::string in_camel_case(const std::string& name) {
  std::string text;
  bool begins = true;
  for (const char c : name) {
    if (c != '_') text += begins ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : c;
    begins = c == '_';
  }
  return text;
}

/// NaN says it of a number, has_NAME of all else.
bool says_whether_there(const StreamColumn& column) { return column.may_be_null && column.kind != CellKind::kNumber; }

std::uint8_t number_of(const StreamColumn& column, const std::string& label) {
  const auto at = std::ranges::find(column.labels, label);
  return at == column.labels.end() ? kOtherLabel : static_cast<std::uint8_t>(at - column.labels.begin());
}

/// What stands for NULL where has_NAME is false: 0 and "".
template <class T>
T there(const log::Value& cell, std::size_t place) {
  if (std::holds_alternative<std::monostate>(cell)) return {};
  return log::cell_as<T>(cell, place);
}

void write_cell(Cdr& cdr, const StreamColumn& column, const log::Value& cell, std::size_t place) {
  const bool is_null = std::holds_alternative<std::monostate>(cell);
  if (is_null && !column.may_be_null) throw log::WrongCell{place, "there"};
  if (says_whether_there(column)) cdr.put(!is_null);
  switch (column.kind) {
    case CellKind::kInteger:
      return cdr.put(there<std::int64_t>(cell, place));
    case CellKind::kTruth:
      return cdr.put(there<bool>(cell, place));
    case CellKind::kNumber:
      return cdr.put(is_null ? std::numeric_limits<double>::quiet_NaN() : log::cell_as<double>(cell, place));
    case CellKind::kLabel:
      return cdr.put(is_null ? std::uint8_t{0} : number_of(column, log::cell_as<std::string>(cell, place)));
    default:
      return cdr.put_text(there<std::string>(cell, place));
  }
}

}  // namespace

Schema schema_of(const log::StreamTable& table) {
  std::string text = fmt::format("# {}\n", table.meaning);
  for (const StreamColumn& column : table.columns) {
    for (std::size_t i = 0; i < column.labels.size(); ++i)
      text += fmt::format("uint8 {}_{}={}\n", upper(column.name), upper(column.labels[i]), i);
    if (!column.labels.empty()) text += fmt::format("uint8 {}_OTHER_LABEL={}\n", upper(column.name), kOtherLabel);
    if (says_whether_there(column)) text += fmt::format("bool has_{}\n", column.name);
    text += fmt::format("{} {}  # {}\n", type_of(column.kind), column.name, column.meaning);
  }
  return {"trivela_msgs/msg/" + in_camel_case(singular(table.name)), text};
}

void write_row(Cdr& cdr, const log::StreamTable& table, std::span<const log::Value> row) {
  cdr.begin();
  for (std::size_t i = 0; i < row.size(); ++i) write_cell(cdr, table.columns[i], row[i], i);
}

}  // namespace trivela::evaluator::mcap
