#include <fmt/format.h>

#include "evaluator/render/text_table.hpp"
#include "evaluator/table2/report_parts.hpp"
#include "kicking/text/printable.hpp"

namespace trivela::evaluator {
namespace {

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
    if (!part.table.empty()) text += markdown_table(part.table);
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
    if (!part.table.empty()) text += latex_table(part.table);
    latex_list(text, part.notes);
  }
  return parts.last.empty() ? text : fmt::format("{}\n{}\n", text, latex_text(parts.last));
}

}  // namespace trivela::evaluator
