#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

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

}  // namespace trivela::evaluator
