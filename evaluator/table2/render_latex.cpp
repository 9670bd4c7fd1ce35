#include <fmt/format.h>

#include "evaluator/render/escaped_text.hpp"
#include "evaluator/table2/report_parts.hpp"

namespace trivela::evaluator {
namespace {

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
