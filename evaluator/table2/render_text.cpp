#include <fmt/format.h>

#include "evaluator/render/text_table.hpp"
#include "evaluator/table2/report_parts.hpp"
#include "kicking/text/printable.hpp"

namespace trivela::evaluator {
namespace {

void markdown_row(std::string& text, const std::vector<std::string>& cells) {
  for (const std::string& cell : cells) text += fmt::format("| {} ", markdown_text(cell));
  text += "|\n";
}

void markdown_table(std::string& text, const std::vector<std::vector<std::string>>& table) {
  markdown_row(text, table.front());
  for (std::size_t i = 0; i < table.front().size(); ++i) text += i == 0 ? "|:---" : "|---:";
  text += "|\n";
  for (std::size_t i = 1; i < table.size(); ++i) markdown_row(text, table[i]);
}

void latex_row(std::string& text, const std::vector<std::string>& cells) {
  for (std::size_t i = 0; i < cells.size(); ++i) text += (i == 0 ? "" : " & ") + latex_text(cells[i]);
  text += " \\\\\n";
}

void latex_table(std::string& text, const std::vector<std::vector<std::string>>& table) {
  text += fmt::format("\\begin{{tabular}}{{l{}}}\n\\hline\n", std::string(table.front().size() - 1, 'r'));
  latex_row(text, table.front());
  text += "\\hline\n";
  for (std::size_t i = 1; i < table.size(); ++i) latex_row(text, table[i]);
  text += "\\hline\n\\end{tabular}\n\n";
}

// No list without an item: LaTeX refuses it.
void latex_list(std::string& text, const std::vector<std::string>& lines) {
  if (lines.empty()) return;
  text += "\\begin{itemize}\n";
  for (const std::string& line : lines)
    text += fmt::format("\\item {}\n", latex_text(line.substr(line.find_first_not_of(' '))));
  text += "\\end{itemize}\n";
}

}  // namespace

std::string to_text(const Report& report) {
  using kicking::printable;
  const ReportParts parts = parts_of(report);
  std::string text;
  for (const std::string& line : parts.heading) text += printable(line) + "\n";
  for (const ReportPart& part : parts.parts) {
    text += fmt::format("\n{}\n", part.title);
    if (!part.table.empty()) text += text_table(part.table);
    for (const std::string& note : part.notes) text += fmt::format("  {}\n", printable(note));
  }
  return parts.last.empty() ? text : fmt::format("{}\n{}\n", text, printable(parts.last));
}

std::string to_markdown(const Report& report) {
  const ReportParts parts = parts_of(report);
  std::string text = "# Report\n\n";
  for (const std::string& line : parts.heading)
    text += fmt::format("{}- {}\n", line.starts_with("  ") ? "  " : "",
                        markdown_text(line.substr(line.find_first_not_of(' '))));
  for (const ReportPart& part : parts.parts) {
    text += fmt::format("\n## {}\n\n", markdown_text(part.title));
    if (!part.table.empty()) markdown_table(text, part.table);
    if (!part.table.empty() && !part.notes.empty()) text += "\n";
    for (const std::string& note : part.notes) text += fmt::format("- {}\n", markdown_text(note));
  }
  return parts.last.empty() ? text : fmt::format("{}\n{}\n", text, markdown_text(parts.last));
}

std::string to_latex(const Report& report) {
  const ReportParts parts = parts_of(report);
  std::string text = "% For \\input; \\usepackage[T1]{fontenc} and \\usepackage{textcomp} have every character.\n";
  latex_list(text, parts.heading);
  for (const ReportPart& part : parts.parts) {
    text += fmt::format("\n\\subsection*{{{}}}\n", latex_text(part.title));
    if (!part.table.empty()) latex_table(text, part.table);
    latex_list(text, part.notes);
  }
  return parts.last.empty() ? text : fmt::format("{}\n{}\n", text, latex_text(parts.last));
}

}  // namespace trivela::evaluator
