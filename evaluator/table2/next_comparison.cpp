#include "evaluator/table2/report_sentences.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace trivela::evaluator {
namespace {

constexpr std::size_t kMostLogs = 8;

std::string logs_of(const Report& report) {
  if (report.logs.size() > kMostLogs) return fmt::format(" LOG... (these {})", report.logs.size());
  std::string text;
  for (const std::string& log : report.logs) text += " " + shell_word(log);
  return text;
}

// ", by these counts alone: ..." of two policies.
std::string counts_of(const Report& report) {
  if (report.policies.size() != 2) return "";
  std::string text = "; by these counts alone: trivela compare --counts";
  for (const PolicyRow& row : report.policies) {
    if (row.counts().n == 0) return "";
    text += fmt::format(" {}", shell_word(fmt::format("{}={}/{}", row.policy, row.counts().inside, row.counts().n)));
  }
  return text;
}

}  // namespace

std::string shell_word(const std::string& word) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-./=+:,@%").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::ranges::all_of(word, plain) && word.front() != '-') return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string next_comparison(const Report& report) {
  const bool kicks = std::ranges::any_of(report.policies, [](const PolicyRow& row) { return row.kicks() > 0; });
  const bool replays = std::ranges::any_of(
      report.sessions, [](const log::RecordedSession& session) { return !session.replays_uuid.empty(); });
  if (!kicks || replays) return "";
  const bool apart = std::ranges::any_of(report.policies, &PolicyRow::blocked_apart);
  const std::string rest = logs_of(report) + (apart ? " --blocked apart" : "");
  if (report.arms.size() > 1) return fmt::format("How sure are the differences: trivela compare{} --by arm", rest);
  if (report.policies.size() > 1)
    return fmt::format("How sure is the difference: trivela compare{}{}", rest, counts_of(report));
  if (report.logs.size() > 1)
    return fmt::format("How sure is the difference between the logs: trivela compare{} --by log", rest);
  if (!report.robots.empty())
    return fmt::format("How sure is the difference between the robots: trivela compare{} --by robot", rest);
  return fmt::format("To compare it with another log: trivela compare{} OTHER.db", rest);
}

}  // namespace trivela::evaluator
