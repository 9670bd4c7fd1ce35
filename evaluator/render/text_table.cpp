#include "evaluator/render/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "kicking/text/printable.hpp"

namespace trivela::evaluator {
namespace {

using kicking::printable;
using Pair = std::pair<char, std::string_view>;

constexpr std::array kLatex{Pair{'\\', "\\textbackslash{}"},
                            Pair{'~', "\\textasciitilde{}"},
                            Pair{'^', "\\textasciicircum{}"},
                            Pair{'<', "\\textless{}"},
                            Pair{'>', "\\textgreater{}"},
                            Pair{'|', "\\textbar{}"},
                            Pair{'"', "\\textquotedbl{}"},
                            Pair{'`', "\\textasciigrave{}"},
                            Pair{'{', "\\{"},
                            Pair{'\'', "\\textquotesingle{}"},
                            Pair{'}', "\\}"},
                            Pair{'$', "\\$"},
                            Pair{'&', "\\&"},
                            Pair{'#', "\\#"},
                            Pair{'_', "\\_"},
                            Pair{'%', "\\%"},
                            Pair{'[', "{[}"},
                            Pair{']', "{]}"}};

// Characters that Markdown gives a meaning anywhere in a line; a backslash takes it away.
constexpr std::string_view kMarkup = "\\`*_{}[]|~$#";

// Characters that a backslash does not keep from being a link, a mention or an entity.
constexpr std::array kMarkdown{Pair{'&', "&amp;"}, Pair{'<', "&lt;"}, Pair{'>', "&gt;"}, Pair{'@', "&#64;"}};

constexpr std::array kXml{Pair{'<', "&lt;"}, Pair{'>', "&gt;"}, Pair{'&', "&amp;"}, Pair{'"', "&quot;"},
                          Pair{'\'', "&#39;"}};

std::string_view replaced(const auto& pairs, char c) {
  for (const auto& [from, to] : pairs)
    if (c == from) return to;
  return {};
}

// Whether the character at `i` makes the line an item of a list, or the rest a link.
bool begins_something(std::string_view text, std::size_t i) {
  const char c = text[i];
  const bool blank_follows = i + 1 == text.size() || text[i + 1] == ' ' || text[i + 1] == '\t';
  if (c == '-' || c == '+') return i == 0 && text.size() > 1 && blank_follows;
  const bool numbered = i > 0 && text.substr(0, i).find_first_not_of("0123456789") == std::string_view::npos;
  if (c == ')') return numbered && blank_follows;
  return c == '.' && ((numbered && blank_follows) || text.substr(0, i).ends_with("www"));
}

}  // namespace

std::string text_table(const std::vector<std::vector<std::string>>& rows) {
  auto cells = rows;
  std::vector<std::size_t> widths;
  for (auto& row : cells) {
    for (std::string& cell : row) cell = kicking::printable(cell);
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const auto& row : cells) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      text += i == 0 ? fmt::format("  {:<{}}", row[i], widths[i]) : fmt::format("  {:>{}}", row[i], widths[i]);
    }
    text += "\n";
  }
  return text;
}

std::string markdown_table(const std::vector<std::vector<std::string>>& rows) {
  std::string text;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (const std::string& cell : rows[i]) text += fmt::format("| {} ", markdown_text(cell));
    text += "|\n";
    for (std::size_t j = 0; i == 0 && j < rows[i].size(); ++j) text += j == 0 ? "|:---" : "|---:";
    if (i == 0) text += "|\n";
  }
  return text;
}

std::string latex_table(const std::vector<std::vector<std::string>>& rows) {
  std::string text = fmt::format("\\begin{{tabular}}{{l{}}}\n\\hline\n", std::string(rows.front().size() - 1, 'r'));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = 0; j < rows[i].size(); ++j) text += (j == 0 ? "" : " & ") + latex_text(rows[i][j]);
    text += i == 0 ? " \\\\\n\\hline\n" : " \\\\\n";
  }
  return text + "\\hline\n\\end{tabular}\n\n";
}

std::string percent(double fraction) { return fmt::format("{:.1f} %", 100.0 * fraction); }

std::string percent(stats::Interval fractions) {
  return fmt::format("{} to {}", percent(fractions.lo), percent(fractions.hi));
}

std::string words(std::string label) {
  std::ranges::replace(label, '_', ' ');
  return label;
}

std::string markdown_text(std::string_view text) {
  const std::string shown = printable(text);
  std::string line;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const char c = shown[i];
    if (const std::string_view entity = replaced(kMarkdown, c); !entity.empty()) {
      line += entity;
    } else if (c == ':' && std::string_view(shown).substr(i).starts_with("://")) {
      line += "&#58;";  // no address that is made a link
    } else {
      if (kMarkup.find(c) != std::string_view::npos || begins_something(shown, i)) line += '\\';
      line += c;
    }
  }
  return line;
}

std::string latex_text(std::string_view text) {
  std::string line;
  for (const char c : printable(text)) {
    if (c == '-' && line.ends_with('-')) line += "{}";  // two would be a dash
    const std::string_view command = replaced(kLatex, c);
    command.empty() ? line += c : line += command;
  }
  return line;
}

std::string xml_text(std::string_view text, bool quotes) {
  std::string out;
  for (const char c : text) {
    const bool stays = !quotes && (c == '"' || c == '\'');
    const std::string_view entity = stays ? "" : replaced(kXml, c);
    entity.empty() ? out += c : out += entity;
  }
  return out;
}

std::string csv_text(std::string_view text) {
  std::string cell = printable(text);
  if (!cell.empty() && std::string_view("=+-@\t").find(cell.front()) != std::string_view::npos) cell.insert(0, "'");
  if (cell.find_first_of(",\"") == std::string::npos) return cell;
  std::string quoted = "\"";
  for (const char c : cell) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace trivela::evaluator
