#include "cli/options/shard_option.hpp"

#include <fmt/format.h>

#include <charconv>

#include "cli/verbs.hpp"

namespace trivela::cli {
namespace {

using log::Shard;

/// None: it is no shard.
std::optional<Shard> shard_of(const std::string& text) {
  Shard shard;
  const char* const end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, shard.number);
  if (number.ec != std::errc{} || number.ptr == end || *number.ptr != '/') return std::nullopt;
  const auto count = std::from_chars(number.ptr + 1, end, shard.count);
  const bool holds = count.ec == std::errc{} && count.ptr == end && shard.number >= 1 && shard.number <= shard.count;
  return holds ? std::optional{shard} : std::nullopt;
}

}  // namespace

void add_shard_option(CLI::App& verb, std::optional<Shard>& shard, const std::string& footnote) {
  verb.add_option_function<std::string>(
          "--shard", [&shard](const std::string& text) { shard = shard_of(text); },
          "Play the K-th of N parts of the matches alone; " + footnote)
      ->check(CLI::Validator(
          [](std::string& text) {
            return shard_of(text) ? std::string{} : fmt::format("{} is not K/N with K from 1 to N", text);
          },
          ""))
      ->type_name("K/N");
}

void check_shard(const std::optional<Shard>& shard, std::uint32_t matches) {
  if (shard && shard->count > matches)
    throw UsageError{fmt::format("--shard {}: more parts than --matches {}", shard->text(), matches)};
}

}  // namespace trivela::cli
