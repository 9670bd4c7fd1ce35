#include "cli/import/kick_labels.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "config/text/csv_reader.hpp"
#include "config/text/csv_row.hpp"
#include "config/text/parse_number.hpp"
#include "kicking/policy/policy.hpp"

namespace trivela::cli {
namespace {

using config::CellError;

constexpr std::array<std::string_view, 4> kNeeded{"time", "policy", "outcome", "by"};
constexpr std::array<std::string_view, 2> kOptional{"half", "robot"};
constexpr int kParts = 4;  // two halves and the two of the overtime
constexpr double kLongestVideo_s = 86'400.0;

std::string needed_word(const config::Row& row, const char* column) {
  const auto word = row.word(column);
  if (!word) throw CellError(column, "", "is empty");
  return *word;
}

/// "83.5", "1:23.5" and "1:02:03" are seconds, minutes and hours before them.
double video_time_s(const std::string& text) {
  double time_s = 0.0;
  std::istringstream parts(text);
  int n = 0;
  for (std::string part; std::getline(parts, part, ':'); ++n) {
    const auto number = config::parse_decimal(part);
    const bool last = parts.eof();
    const bool whole = number && (last || *number == std::floor(*number));
    if (!whole || !(*number >= 0.0) || (n > 0 && *number >= 60.0) || n > 2)
      throw CellError("time", text, "is no time: write seconds, m:ss or h:mm:ss");
    time_s = 60.0 * time_s + *number;
  }
  if (text.ends_with(':') || time_s > kLongestVideo_s)
    throw CellError("time", text, "is no time of a video of at most 24 h: write seconds, m:ss or h:mm:ss");
  return time_s;
}

msg::Policy policy_of(const std::string& name) {
  std::vector<std::string_view> names;
  for (const kicking::PolicyFacts& policy : kicking::kPolicyFacts)
    if (policy.plays()) names.emplace_back(policy.name);
  const auto policy = bus::from_label<msg::Policy>(name);
  if (!policy || std::ranges::find(names, name) == names.end())
    throw CellError("policy", name, fmt::format("is none of {}", fmt::join(names, ", ")));
  return *policy;
}

void set_outcome(KickLabel& kick, const std::string& word) {
  const bool goal = word == "goal", saved = word == "saved";
  if (goal || saved) kick.saved = saved;
  if (!goal && !saved && word != "inside" && word != "outside") {
    const auto outcome = bus::from_label<msg::Outcome>(word);
    if (!outcome || word == "on_target") {
      throw CellError(
          "outcome", word,
          "is none of goal, saved, inside, outside, unknown, wide_left, wide_right, over, short, post, bar, blocked");
    }
    kick.outcome = *outcome;
    kick.outside = *outcome != msg::OUTCOME_UNKNOWN;
    return;
  }
  kick.outside = word == "outside";
  kick.outcome = kick.outside ? msg::OUTCOME_UNKNOWN : msg::OUTCOME_ON_TARGET;
}

int whole_in(const config::Row& row, const char* column, int low, int high, int otherwise) {
  if (!row.word(column)) return otherwise;
  const double number = row.number_in(column, low, high);
  if (number != std::floor(number)) throw CellError(column, *row.word(column), "is not whole");
  return static_cast<int>(number);
}

void check_columns(const std::vector<std::string>& header, const std::string& file) {
  for (const std::string_view column : kNeeded) {
    if (std::ranges::find(header, column) == header.end())
      throw std::runtime_error(
          fmt::format("{}: no column {} in the header ({})", file, column, fmt::join(header, ", ")));
  }
  for (const std::string& column : header) {
    const bool known =
        std::ranges::find(kNeeded, column) != kNeeded.end() || std::ranges::find(kOptional, column) != kOptional.end();
    if (known && std::ranges::count(header, column) == 1) continue;
    throw std::runtime_error(fmt::format("{}: column {} {} (columns are {}; {})", file, column,
                                         known ? "stands twice in the header" : "means nothing here",
                                         fmt::join(kNeeded, ", "), fmt::join(kOptional, ", ")));
  }
}

KickLabel label_of(const config::Row& row) {
  KickLabel kick;
  if (const auto time = row.word("time")) kick.time_s = video_time_s(*time);
  kick.policy = policy_of(needed_word(row, "policy"));
  set_outcome(kick, needed_word(row, "outcome"));
  kick.by = needed_word(row, "by");
  kick.half = whole_in(row, "half", 1, kParts, 1);
  kick.robot_id = whole_in(row, "robot", 1, 255, 0);
  return kick;
}

}  // namespace

std::set<std::string> KickLabels::labellers() const {
  std::set<std::string> names;
  for (const KickLabel& kick : kicks) names.insert(kick.by);
  return names;
}

std::int64_t KickLabels::timed() const {
  return std::ranges::count_if(kicks, [](const KickLabel& kick) { return kick.time_s.has_value(); });
}

KickLabels read_kick_labels(std::istream& in, const std::string& file) {
  KickLabels labels{.file = file, .text = config::read_text(in, file), .kicks = {}};
  std::istringstream text(labels.text);
  config::CsvReader reader(text, file);
  const auto head = reader.next();
  if (!head) throw std::runtime_error(file + ": no header line");
  const std::vector<std::string> header = config::trimmed(head->cells);
  check_columns(header, file);
  while (const auto record = reader.next()) {
    try {
      config::check_width(header, *record);
      labels.kicks.push_back(label_of({header, record->cells}));
    } catch (const CellError& error) {
      throw std::runtime_error(fmt::format("{}:{}: {}", file, record->line, error.what()));
    }
  }
  if (labels.kicks.empty()) throw std::runtime_error(file + ": no kick in it");
  return labels;
}

}  // namespace trivela::cli
