#pragma once

#include <cstddef>
#include <istream>
#include <optional>
#include <string>
#include <vector>

namespace trivela::cli {

/// One record of a CSV text and the line that it starts on, from 1.
struct CsvRecord {
  std::size_t line = 0;
  std::vector<std::string> cells;
};

/// Reads CSV records: quoted cells (commas, doubled quotes and line ends inside), LF or CRLF, a byte order mark;
/// lines that begin with '#' and empty lines are passed over.
class CsvReader {
 public:
  explicit CsvReader(std::istream& in) : in_(in) {}

  /// The next record, none at the end.
  std::optional<CsvRecord> next() {
    std::string text;
    while (read_line(text)) {
      if (line_ == 1 && text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
      if (text.empty() || text.front() == '#') continue;
      return split(text);
    }
    return std::nullopt;
  }

 private:
  bool read_line(std::string& text) {
    if (!std::getline(in_, text)) return false;
    ++line_;
    if (!text.empty() && text.back() == '\r') text.pop_back();
    return true;
  }

  CsvRecord split(std::string text) {
    CsvRecord record{line_, {""}};
    bool quoted = false;
    do {
      for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        std::string& cell = record.cells.back();
        if (c == '"' && quoted && i + 1 < text.size() && text[i + 1] == '"') {
          cell += text[++i];
        } else if (c == '"' && (quoted || cell.empty())) {
          quoted = !quoted;
        } else if (c == ',' && !quoted) {
          record.cells.emplace_back();
        } else {
          cell += c;
        }
      }
      if (quoted) record.cells.back() += '\n';
    } while (quoted && read_line(text));
    return record;
  }

  std::istream& in_;
  std::size_t line_ = 0;
};

}  // namespace trivela::cli
