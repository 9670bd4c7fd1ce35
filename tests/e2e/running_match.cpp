#include "tests/e2e/running_match.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

#include "tests/e2e/log_rows.hpp"

namespace trivela::e2e {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kPlayedCycles = 100;

std::vector<std::string> arguments(std::vector<std::string> more) {
  std::vector<std::string> all{"match", "--half",   "stopped",   "--half", "moving",
                               "--out", "match.db", "--minutes", "500"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace

RunningMatch::RunningMatch(std::vector<std::string> more_arguments)
    : program_("trivela", arguments(std::move(more_arguments)), folder_.path()) {
  if (!wait_until_recorded(500'000)) {
    throw std::runtime_error{"the match did not get going: " + program_.output() + program_.errors()};
  }
  const Reader growing{log()};
  if (!wait_for_change(folder_.path(), program_.watch(),
                       [&] { return number_of(growing, "SELECT count(*) FROM world_states") > kPlayedCycles; })) {
    throw std::runtime_error{"the match does not go on: " + program_.output() + program_.errors()};
  }
  for (const pid_t child : children_of(program_.id())) nodes_.emplace(program_of(child), ProcessWatch{child});
}

bool RunningMatch::wait_until_recorded(std::uintmax_t bytes) const {
  return wait_for_change(folder_.path(), program_.watch(), [&] {
    std::error_code none_yet;
    std::uintmax_t written = fs::file_size(log().string() + "-wal", none_yet);
    if (none_yet) return false;
    written += fs::file_size(log());
    return written >= bytes;
  });
}

fs::path RunningMatch::config() const {
  const pid_t recorder = node("trivela-recorder").id();
  const std::vector<std::string> words = command_of(recorder);
  const auto flag = std::ranges::find(words, "--config");
  if (words.end() - flag < 2) throw std::runtime_error{"the recorder has no configuration"};
  // The name of an open file of that process.
  return fmt::format("/proc/{}/fd/{}", recorder, fs::path{flag[1]}.filename().string());
}

std::vector<std::string> RunningMatch::nodes_left(std::chrono::milliseconds timeout) const {
  std::vector<std::string> left;
  for (const auto& [program, watch] : nodes_) {
    if (!watch.ended(timeout)) left.push_back(program);
  }
  return left;
}

}  // namespace trivela::e2e
