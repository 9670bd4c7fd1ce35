#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <string_view>

#include "cli/compare/compare_input.hpp"
#include "cli/verbs.hpp"
#include "kicking/text/printable.hpp"

namespace trivela::cli {
namespace {

std::optional<std::int64_t> whole_number(std::string_view text) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc::result_out_of_range) return text.starts_with('-') ? -1 : kMaxKicks + 1;
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

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
