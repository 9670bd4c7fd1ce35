#include <fmt/format.h>

#include "evaluator/render/escaped_text.hpp"
#include "evaluator/table2/report_parts.hpp"

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

}  // namespace

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

}  // namespace trivela::evaluator
