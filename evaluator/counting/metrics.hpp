#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "log/read/reader.hpp"

namespace trivela::evaluator {

/// A question that match logs are asked, evaluator/metrics/NAME.sql.
struct Metric {
  std::string_view name;
  std::string_view sql;

  /// What its head says of it: what it counts, and "Columns: ...", in one line each.
  std::string explanation() const;
};

/// Every file of the folder, by name.
std::span<const Metric> metrics();

/// The metric of this name, if it is one.
std::optional<Metric> metric(std::string_view name);

/// Reader::ask() of an open log, which sentences call `name`: where the question is about counted_kicks, what several
/// sessions recorded of one play, and what a merge holds twice, counts once, as in a report.
void ask_counted(log::Reader& reader, const std::string& name, const std::string& sql, const log::HeadFunction& head,
                 const log::RowFunction& row);

}  // namespace trivela::evaluator
