#include <fmt/format.h>

#include "evaluator/render/text_table.hpp"
#include "evaluator/table2/report_parts.hpp"
#include "kicking/text/printable.hpp"

namespace trivela::evaluator {

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

}  // namespace trivela::evaluator
