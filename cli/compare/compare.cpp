#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <iostream>
#include <optional>
#include <span>
#include <string_view>

#include "cli/compare/compare_input.hpp"
#include "cli/options/gate_option.hpp"
#include "cli/options/number_checks.hpp"
#include "cli/options/output.hpp"
#include "cli/verbs.hpp"
#include "evaluator/compare/policy_comparison.hpp"
#include "evaluator/render/gate.hpp"
#include "evaluator/render/json_values.hpp"
#include "evaluator/stats/counts/most_kicks.hpp"
#include "kicking/text/printable.hpp"

namespace trivela::cli {
namespace {

using evaluator::stats::kMaxKicks;

struct CompareArguments {
  std::vector<std::string> logs;
  std::string csv;
  std::vector<std::string> counts;
  evaluator::ComparisonQuestion question;  ///< what other flags say of it is added by question_of()
  std::string outcome = "observed";
  std::string blocked = "outside";
  double smallest_effect_points = 100.0 * evaluator::stats::kSmallestEffect;
  bool json = false;
  bool all = false;
  std::string out;
  std::vector<std::string> gates;
};

std::string csv_name(const CompareArguments& arguments) {
  return arguments.csv == "-" ? "standard input" : arguments.csv;
}

/// The column of a CSV that has the groups.
std::string group_column(const CompareArguments& arguments) {
  return arguments.question.kicks.by.empty() ? "policy" : arguments.question.kicks.by;
}

evaluator::KickDataset read_csv(const CompareArguments& arguments) {
  const CsvComparison options{group_column(arguments), arguments.question.kicks.stratify,
                              arguments.question.design == "paired"};
  if (arguments.csv == "-") return read_kicks(std::cin, csv_name(arguments), options);
  std::ifstream file = open_file(arguments.csv);
  return read_kicks(file, csv_name(arguments), options);
}

void check(const CompareArguments& arguments) {
  const int sources =
      (arguments.logs.empty() ? 0 : 1) + (arguments.csv.empty() ? 0 : 1) + (arguments.counts.empty() ? 0 : 1);
  if (sources == 0) throw UsageError("compare needs match logs, --csv KICKS.csv or --counts");
  if (sources > 1) throw UsageError("compare takes match logs, --csv or --counts, one of the three");
  if (!(arguments.smallest_effect_points > 0.0 && arguments.smallest_effect_points < 100.0)) {
    throw UsageError(fmt::format("--smallest-effect {}: write percentage points between 0 and 100",
                                 arguments.smallest_effect_points));
  }
  if (arguments.blocked == "apart" && arguments.logs.empty())
    throw UsageError("--blocked apart needs match logs: counts and tables do not say which kicks were blocked");
  if (arguments.counts.empty()) return;
  const evaluator::ComparisonQuestion& asked = arguments.question;
  for (const auto& [flag, given] : {std::pair{"--by", &asked.kicks.by}, std::pair{"--stratify", &asked.kicks.stratify},
                                    std::pair{"--baseline", &asked.baseline}, std::pair{"--design", &asked.design}}) {
    if (!given->empty()) throw UsageError(fmt::format("--counts has no rows, so {} says nothing", flag));
  }
}

evaluator::ComparisonQuestion question_of(const CompareArguments& arguments) {
  evaluator::ComparisonQuestion question = arguments.question;
  question.kicks.truth = arguments.outcome == "truth";
  question.kicks.blocked_apart = arguments.blocked == "apart";
  question.smallest_effect = 0.01 * arguments.smallest_effect_points;
  return question;
}

evaluator::PolicyComparison compared_csv(const CompareArguments& arguments) {
  evaluator::KickDataset dataset = read_csv(arguments);
  try {
    return evaluator::compare_dataset(std::move(dataset), group_column(arguments), question_of(arguments));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", csv_name(arguments), error.what()));  // it knows no file
  }
}

/// Of logs, or of a table of kicks.
evaluator::PolicyComparison compared(const CompareArguments& arguments) try {
  if (arguments.logs.empty()) return compared_csv(arguments);
  return evaluator::compare_logs({arguments.logs.begin(), arguments.logs.end()}, question_of(arguments));
} catch (const evaluator::BadChoice& error) {
  throw UsageError(fmt::format("--{}", error.what()));
} catch (const evaluator::BadOption& error) {
  throw UsageError(fmt::format("--{}", error.what()));
}

void write_out(const std::string& out, const std::string& text) { out.empty() ? say(text) : write_file(out, text); }

// Writes it, then judges its gates.
int write_comparison(const CompareArguments& arguments, auto comparison, std::span<const evaluator::Gate> gates) {
  comparison.gates = evaluator::judge_gates(comparison, gates);
  const std::string text = arguments.json  ? evaluator::to_json(comparison)
                           : arguments.all ? evaluator::to_text(comparison)
                                           : evaluator::to_short_text(comparison);
  write_out(arguments.out, text);
  return warn_of_gates(comparison.gates) ? kDone : kDoneWithLoss;
}

int run_comparison(const CompareArguments& arguments) {
  check(arguments);
  const auto gates = parse_gates(arguments.gates, evaluator::comparison_gate_metrics());
  require_writable("--out", arguments.out);
  if (arguments.counts.empty()) return write_comparison(arguments, compared(arguments), gates);
  const auto [older, newer] = parse_two_counts(arguments.counts);
  return write_comparison(arguments, evaluator::compare(older, newer, 0.01 * arguments.smallest_effect_points), gates);
}

std::optional<std::int64_t> whole_number(std::string_view text) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc::result_out_of_range) return text.starts_with('-') ? -1 : kMaxKicks + 1;
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

void add_compare(CLI::App& app, int& exit_code) {
  const auto [verb, arguments] =
      add_verb(app, exit_code, "compare",
               "Compare policies, height tables, robots, arms or logs: how much, how sure, why", run_comparison);
  verb->add_option("logs", arguments->logs, "Match logs, such as out/match.db; their sessions are taken together")
      ->type_name("DB");
  verb->add_option("--csv", arguments->csv,
                   "A table of kicks instead: columns policy, on_target (1, 0, empty: unknown), and if known match, "
                   "minutes, distance_m, kicked, opportunity and any others")
      ->type_name("FILE|-");
  verb->add_option("--counts", arguments->counts, "NAME=INSIDE/KICKS twice, the older first: old=34/65 new=100/132");
  verb->add_option("--by", arguments->question.kicks.by,
                   "What is compared: policy, table, robot, arm or log; of a CSV any column (arm where a log has "
                   "several, else policy, or log where there is one policy)");
  verb->add_option("--stratify", arguments->question.kicks.stratify,
                   "Compare within situations: distance, or start_distance, robot, half, scenario, table, policy, arm, "
                   "log of a log, any column of a CSV");
  verb->add_option("--baseline", arguments->question.baseline,
                   "The group that the others are compared with (the first)");
  verb->add_option("--design", arguments->question.design, "How the groups came about, where the data do not say it")
      ->check(CLI::IsMember({"before_after", "alternating", "randomised", "paired"}));
  verb->add_option("--outcome", arguments->outcome, "observed: as the robots saw it; truth: the simulator's (observed)")
      ->check(CLI::IsMember({"observed", "truth"}));
  verb->add_option("--blocked", arguments->blocked,
                   "Blocked kicks: outside, as in Table 2, or apart: efficiency is of the others (outside)")
      ->check(CLI::IsMember({"outside", "apart"}));
  verb->add_option("--smallest-effect", arguments->smallest_effect_points,
                   "Smallest difference of interest, in percentage points (5)");
  verb->add_flag("--json", arguments->json, "JSON instead of text");
  verb->add_flag("--all", arguments->all,
                 "Every table, test and reservation, after the one line; JSON has them anyway");
  verb->add_option("--out", arguments->out, "Write to this file, not to standard output")->type_name("FILE");
  add_gates(*verb, arguments->gates, "'difference_lo(moving)>=0', 'kicks>=50'");
  verb->footer(R"(Examples: trivela compare ab.db --outcome truth
          trivela compare --csv kicks.csv --stratify distance
          trivela compare --counts old=34/65 new=100/132    (the paper's Table 2))");
}

evaluator::NamedCounts parse_counts(const std::string& argument) {
  const auto fail = [&](const std::string& why) -> UsageError {
    return UsageError(fmt::format("--counts '{}': {}", argument, why));
  };
  const std::size_t equals = argument.rfind('=');
  const std::size_t slash = argument.find('/', equals == std::string::npos ? 0 : equals);
  if (equals == 0 || equals == std::string::npos || slash == std::string::npos) {
    throw fail("write NAME=INSIDE/KICKS, such as old=34/65");
  }
  const auto inside = whole_number(std::string_view(argument).substr(equals + 1, slash - equals - 1));
  const auto n = whole_number(std::string_view(argument).substr(slash + 1));
  if (kicking::first_unprintable(std::string_view(argument).substr(0, equals)))
    throw fail("the name is not printable UTF-8");
  if (!inside || !n) throw fail("INSIDE and KICKS must be whole numbers");
  if (*inside < 0 || *n < 0) throw fail("a count cannot be negative");
  if (*inside > kMaxKicks || *n > kMaxKicks) throw fail(fmt::format("more than {} kicks", kMaxKicks));
  if (*n == 0) throw fail("without a kick there is nothing to compare");
  if (*inside > *n) throw fail(fmt::format("{} inside of only {} kicks", *inside, *n));
  return {argument.substr(0, equals), {*inside, *n}};
}

std::pair<evaluator::NamedCounts, evaluator::NamedCounts> parse_two_counts(const std::vector<std::string>& arguments) {
  if (arguments.size() != 2) {
    throw UsageError(fmt::format("--counts needs two counts, the older and the newer, but there {} {}",
                                 arguments.size() == 1 ? "is" : "are", arguments.size()));
  }
  auto older = parse_counts(arguments[0]);
  auto newer = parse_counts(arguments[1]);
  if (older.name == newer.name) throw UsageError(fmt::format("--counts: both are called '{}'", older.name));
  return {std::move(older), std::move(newer)};
}

}  // namespace trivela::cli
