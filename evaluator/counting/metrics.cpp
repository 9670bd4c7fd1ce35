#include "evaluator/counting/metrics.hpp"

#include <algorithm>

#include "evaluator/counting/log_opportunities.hpp"
#include "evaluator/metrics/all_metrics.hpp"

namespace trivela::evaluator {

std::string Metric::explanation() const {
  std::string text;
  for (std::string_view rest = sql; rest.starts_with("-- ");) {
    const auto end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = rest.substr(3, end - 3);
    if (!text.empty()) text += line.starts_with("Columns: ") ? '\n' : ' ';
    text += line;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return text;
}

std::span<const Metric> metrics() { return kMetrics; }

std::optional<Metric> metric(std::string_view name) {
  const auto* const found = std::ranges::find(kMetrics, name, &Metric::name);
  if (found == std::end(kMetrics)) return std::nullopt;
  return *found;
}

void ask_counted(log::Reader& reader, const std::string& name, const std::string& sql, const log::HeadFunction& head,
                 const log::RowFunction& row) {
  if (sql.find("counted_kicks") != std::string::npos) read_opportunities(reader, name, false);
  reader.ask(sql, head, row);
}

}  // namespace trivela::evaluator
