#include <fmt/format.h>

#include "evaluator/report/table2.hpp"

namespace trivela::evaluator {
namespace {

std::string cell(std::optional<double> value) { return value ? fmt::format("{}", *value) : ""; }

}  // namespace

std::string to_csv(const Report& report) {
  std::string text =
      "policy,inside,outside,unknown,efficiency,wilson95_lo,wilson95_hi,efficiency_unknown_out,efficiency_unknown_in,"
      "played_min,kicks_per_min";
  for (const std::string& miss : kMisses) text += "," + miss;
  text += ",simulated,data_lost\n";
  for (const PolicyRow& row : report.policies) {
    const auto wilson = row.efficiency_ci();
    const auto bounds = row.efficiency_bounds();
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{}", row.policy, row.inside(), row.outside(), row.unknown(),
                        cell(stats::efficiency(row.counts())), wilson.lo, wilson.hi, bounds.lo, bounds.hi,
                        cell(row.played_min), cell(row.kicks_per_min()));
    for (const std::string& miss : kMisses) text += fmt::format(",{}", row.of(miss));
    text += fmt::format(",{:d},{:d}\n", report.simulated_sessions() > 0, report.data_lost());
  }
  return text;
}

}  // namespace trivela::evaluator
