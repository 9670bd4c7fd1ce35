#include "cli/compare/compare_input.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>
#include <tuple>

#include "cli/kick/csv_rows.hpp"
#include "cli/verbs.hpp"

namespace trivela::cli {
namespace {

using evaluator::Ending;
using evaluator::KickDataset;

constexpr std::size_t kMostStrata = 50;

bool truth_of(const Row& row, const std::string& column) {
  const double value = row.number(column);
  if (value != 0.0 && value != 1.0) throw CellError(column, *row.word(column), "is neither 1 nor 0");
  return value == 1.0;
}

std::string word_of(const Row& row, const std::string& column) {
  const auto word = row.word(column);
  if (!word) throw CellError(column, "", "is empty");
  return *word;
}

Ending ending_of(const Row& row) {
  const auto on_target = row.word("on_target");
  if (row.has("kicked") && !truth_of(row, "kicked")) {
    if (on_target && truth_of(row, "on_target")) throw CellError("on_target", *on_target, "without a kick");
    return Ending::kNoKick;
  }
  if (!on_target) return Ending::kUnknown;
  return truth_of(row, "on_target") ? Ending::kInside : Ending::kOutside;
}

// Places of words, by a map since matches may be many.
class Places {
 public:
  std::uint32_t of(const std::string& word) {
    return numbers_.try_emplace(word, static_cast<std::uint32_t>(numbers_.size())).first->second;
  }
  std::uint32_t size() const { return static_cast<std::uint32_t>(numbers_.size()); }

 private:
  std::map<std::string, std::uint32_t> numbers_;
};

// Lines by policy, match and opportunity: a second one has no partner of its own.
class Plays {
 public:
  void add(const evaluator::Opportunity& opportunity, const Row& row, const std::string& by, std::size_t line) {
    const auto [place, added] = lines_.try_emplace({opportunity.group, opportunity.match, opportunity.id}, line);
    if (added) return;
    throw CellError("opportunity", *row.word("opportunity"),
                    fmt::format("stands in line {} already, with {} '{}'{}", place->second, by, *row.word(by),
                                row.has("match") ? fmt::format(" and match '{}'", *row.word("match")) : ""));
  }

 private:
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint64_t>, std::size_t> lines_;
};

void check_stratum(const CsvComparison& options) {
  for (const char* outcome : {"on_target", "kicked"}) {
    if (options.by == outcome) throw UsageError(fmt::format("--by {}: that is the outcome, not a group", outcome));
    if (options.stratify == outcome) {
      throw UsageError(fmt::format("--stratify {}: that is the outcome, not a situation", outcome));
    }
  }
}

void check_header(const std::vector<std::string>& header, const std::string& file, const CsvComparison& options) {
  const auto has = [&](const std::string& name) { return std::ranges::find(header, name) != header.end(); };
  const auto missing = [&](const std::string& name) {
    return fmt::format("{}: no column {} in the header ({})", file, name, fmt::join(header, ", "));
  };
  if (!has(options.by) && options.by != "policy")
    throw UsageError(fmt::format("--by {}: {}", options.by, missing(options.by)));
  for (const std::string& needed : {options.by, std::string{"on_target"}})
    if (!has(needed)) throw std::runtime_error(missing(needed));
  const std::string situation = options.stratify == "distance" ? "distance_m" : options.stratify;
  if (!situation.empty() && !has(situation))
    throw UsageError(fmt::format("--stratify {}: {}", options.stratify, missing(situation)));
  for (const std::string& name : header) {
    if (const auto n = std::ranges::count(header, name); n > 1) {
      throw std::runtime_error(fmt::format("{}: column {} stands {} times in the header", file, name, n));
    }
  }
}

void add_minutes(KickDataset& dataset, const Row& row, const evaluator::Opportunity& opportunity) {
  const auto minutes = row.number_if_any("minutes");
  if (!minutes) return;
  if (*minutes <= 0.0) throw CellError("minutes", *row.word("minutes"), "is not above 0");
  const auto [place, added] = dataset.minutes.try_emplace({opportunity.group, opportunity.match}, *minutes);
  if (added || place->second == *minutes) return;
  throw CellError("minutes", *row.word("minutes"),
                  fmt::format("differs from {} in an earlier row of the same group and match", place->second));
}

std::optional<double> distance_of(const Row& row) {
  const auto distance_m = row.number_if_any("distance_m");
  if (distance_m && *distance_m < 0.0) throw CellError("distance_m", *row.word("distance_m"), "is negative");
  return distance_m;
}

std::uint32_t stratum_of(KickDataset& dataset, const Row& row, const std::string& column) {
  if (column.empty()) return 0;
  if (column == "distance") {
    const auto distance_m = distance_of(row);
    return distance_m ? evaluator::distance_bin(*distance_m) : static_cast<std::uint32_t>(dataset.strata.size());
  }
  const auto word = row.word(column);
  if (!word) return UINT32_MAX;
  const std::uint32_t place = evaluator::place_of(dataset.strata, *word);
  if (dataset.strata.size() <= kMostStrata) return place;
  throw CellError(column, *word,
                  fmt::format("is one of more than {} different values: too many to stratify by", kMostStrata));
}

}  // namespace

KickDataset read_kicks(std::istream& in, const std::string& file, const CsvComparison& options) {
  check_stratum(options);
  config::CsvReader reader(in, file);
  const auto head = reader.next();
  if (!head) throw std::runtime_error(file + ": no header line");
  const std::vector<std::string> header = config::trimmed(head->cells);
  check_header(header, file, options);
  KickDataset dataset;
  dataset.stratified_by = options.stratify;
  if (options.stratify == "distance") dataset.strata = evaluator::distance_bins();
  Places matches, opportunities;
  Plays plays;
  const auto has = [&](const char* name) { return std::ranges::find(header, name) != header.end(); };
  const bool once_each = has("opportunity") && (has("match") || options.paired);
  while (const auto record = reader.next()) {
    try {
      check_width(header, *record);
      const Row row(header, record->cells);
      evaluator::Opportunity opportunity{.ending = ending_of(row)};
      opportunity.group = evaluator::place_of(dataset.groups, word_of(row, options.by));
      if (row.has("match")) opportunity.match = matches.of(word_of(row, "match"));
      if (row.has("opportunity")) opportunity.id = opportunities.of(word_of(row, "opportunity")) + 1;
      distance_of(row);
      opportunity.stratum = stratum_of(dataset, row, options.stratify);
      if (once_each) plays.add(opportunity, row, options.by, record->line);
      add_minutes(dataset, row, opportunity);
      dataset.opportunities.push_back(opportunity);
    } catch (const CellError& error) {
      throw std::runtime_error(fmt::format("{}:{}: {}", file, record->line, error.what()));
    }
  }
  dataset.has_opportunities = has("kicked");
  dataset.has_matches = has("match");
  dataset.matches = matches.size();
  const auto unknown = static_cast<std::uint32_t>(dataset.strata.size());
  for (evaluator::Opportunity& opportunity : dataset.opportunities) {
    opportunity.stratum = std::min(opportunity.stratum, unknown);
  }
  dataset.outcome = "table";
  dataset.design_reason = "a table of kicks does not say how the policies were assigned; --design does";
  return dataset;
}

}  // namespace trivela::cli
