#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <istream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "config/text/open_file.hpp"
#include "kicking/text/printable.hpp"

namespace trivela::config {

/// One record of a CSV text and the line that it starts on, from 1.
struct CsvRecord {
  std::size_t line = 0;
  std::vector<std::string> cells;
};

/// Reads the records of a table, the same way for every verb. The first line that is no comment says what stands
/// between the cells: commas, else tabs, else blanks. Cells may be quoted (separators, doubled quotes and line ends
/// inside), lines end with LF or CRLF, a byte order mark may come first. Passed over are empty lines, rows of empty
/// cells, and what follows a '#' at the beginning of a line or behind a blank or separator. Cells are printable UTF-8.
/// `file`: what errors call it.
class CsvReader {
 public:
  explicit CsvReader(std::istream& in, std::string file = "CSV") : in_(in), file_(std::move(file)) {}

  /// The next record, none at the end. Throws std::runtime_error naming file, line and column (from 1) for a table
  /// whose cells are apart by semicolons, a quote that is never closed or closed within a cell, a line or cell of more
  /// than 1 MB, a byte that is not UTF-8, and a control character.
  std::optional<CsvRecord> next() {
    std::string text;
    while (read_line(text)) {
      if (line_ == 1 && text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
      const std::size_t first = text.find_first_not_of(" \t");
      if (first == std::string::npos || text[first] == '#') continue;
      if (separator_ == '\0') find_separator(text);
      CsvRecord record = split(std::move(text));
      if (std::ranges::any_of(record.cells, [](const std::string& cell) { return !is_blank(cell); })) return record;
    }
    return std::nullopt;
  }

 private:
  bool read_line(std::string& text) {
    if (!get_line(in_, text, file_, line_ + 1)) return false;
    ++line_;
    if (!text.empty() && text.back() == '\r') text.pop_back();
    return true;
  }

  [[noreturn]] void fail(std::size_t line, std::size_t column, const std::string& what) const {
    throw std::runtime_error(fmt::format("{}:{}: column {}: {}", file_, line, column, what));
  }

  [[noreturn]] void fail_on_byte(std::size_t column, const std::string& text, std::size_t place) const {
    const unsigned byte = static_cast<unsigned char>(text[place]);
    fail(line_, column,
         kicking::utf8_length(std::string_view(text).substr(place)) == 0
             ? fmt::format("byte 0x{:02X} is not UTF-8", byte)
             : fmt::format("a control character (byte 0x{:02X}) in a cell", byte));
  }

  static bool is_blank(std::string_view cell) { return cell.find_first_not_of(" \t\n") == std::string_view::npos; }

  void find_separator(const std::string& text) {
    bool quoted = false;
    std::size_t commas = 0, semicolons = 0, tabs = 0, aligned = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
      quoted = quoted != (text[i] == '"');
      if (quoted) continue;
      commas += text[i] == ',' ? 1 : 0;
      semicolons += text[i] == ';' ? 1 : 0;
      tabs += text[i] == '\t' ? 1 : 0;
      aligned += i > 0 && is_gap(text[i]) && is_gap(text[i - 1]) ? 1 : 0;
    }
    if (semicolons > 0 && semicolons >= commas)
      throw std::runtime_error(
          fmt::format("{}:{}: the cells are apart by ; : save the table with , and decimal points", file_, line_));
    const bool blanks = text.find_first_of(" \t", text.find_first_not_of(" \t")) != std::string::npos;
    separator_ = commas > 0 || !blanks ? ',' : tabs > 0 && aligned == 0 ? '\t' : ' ';
  }

  static bool is_gap(char c) { return c == ' ' || c == '\t'; }
  bool separates(char c) const { return c == separator_ || (separator_ == ' ' && c == '\t'); }

  /// Whether a '#' behind `before` begins a comment.
  bool begins_comment(const std::string& text, std::size_t i) const {
    return text[i] == '#' && (i == 0 || text[i - 1] == ' ' || text[i - 1] == '\t' || separates(text[i - 1]));
  }

  CsvRecord split(std::string text) {
    CsvRecord record{line_, {""}};
    bool quoted = false, closed = false;  // within quotes; behind the quote that ended the cell
    std::size_t opened_on = 0;
    do {
      const std::size_t unprintable = kicking::first_unprintable(text).value_or(text.size());
      for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (i == unprintable) fail_on_byte(record.cells.size(), text, i);
        std::string& cell = record.cells.back();
        if (c == '"' && quoted && i + 1 < text.size() && text[i + 1] == '"') {
          cell += text[++i];
        } else if (c == '"' && (quoted || (cell.empty() && !closed))) {
          quoted = !quoted;
          closed = !quoted;
          if (quoted) opened_on = line_;
        } else if (!quoted && begins_comment(text, i)) {
          break;
        } else if (!quoted && separates(c)) {
          if (separator_ == ' ' && cell.empty() && !closed) continue;  // blanks in a row are one
          record.cells.emplace_back();
          closed = false;
        } else if (!closed) {
          cell += c;
        } else if (c != ' ' && c != '\t') {
          fail(line_, record.cells.size(),
               fmt::format("text behind the closing quote of the cell whose quote opens on line {}", opened_on));
        }
      }
      if (quoted) record.cells.back() += '\n';
      if (record.cells.back().size() > kLongestCell_B)
        fail(opened_on, record.cells.size(), fmt::format("more than {} MB in a cell", kLongestCell_B >> 20));
    } while (quoted && read_line(text));
    if (quoted) fail(opened_on, record.cells.size(), "the quote that opens here is never closed");
    if (separator_ == ' ' && record.cells.size() > 1 && record.cells.back().empty()) record.cells.pop_back();
    return record;
  }

  static constexpr std::size_t kLongestCell_B = 1 << 20;

  std::istream& in_;
  std::string file_;
  std::size_t line_ = 0;
  char separator_ = '\0';  // ' ' stands for any run of blanks and tabs
};

}  // namespace trivela::config
