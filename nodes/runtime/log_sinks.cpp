#include "nodes/runtime/log_sinks.hpp"

#include <fmt/core.h>

#include <cctype>

namespace trivela::nodes {
namespace {

constexpr std::size_t kTelling = 48;  // characters that tell kinds apart
constexpr std::chrono::seconds kSpan{1};

std::string kind_of(std::string_view text) {
  std::string kind;
  for (const char c : text.substr(0, kTelling))
    if (std::isdigit(static_cast<unsigned char>(c)) == 0) kind += c;
  return kind;
}

}  // namespace

void LimitedSink::tell(const Kind& kind, Time now) {
  if (kind.lines <= kLinesPerSecond) return;
  const std::string text = fmt::format("{} more like this: {}", kind.lines - kLinesPerSecond, kind.last);
  spdlog::details::log_msg message(now, {}, kind.logger, kind.level, text);
  out_->log(message);
}

void LimitedSink::tell_all() {
  const Time now = spdlog::log_clock::now();
  for (const auto& [name, kind] : kinds_) tell(kind, now);
  kinds_.clear();
}

void LimitedSink::sink_it_(const spdlog::details::log_msg& message) {
  const std::string_view text(message.payload.data(), message.payload.size());
  std::string name = kind_of(text);
  if (kinds_.size() >= kMostKinds && !kinds_.contains(name)) name.clear();
  Kind& kind = kinds_[name];
  if (message.time - kind.second >= kSpan) {
    tell(kind, message.time);
    kind = {.second = message.time, .lines = 0, .level = message.level, .logger = {}, .last = {}};
    kind.logger.assign(message.logger_name.data(), message.logger_name.size());
  }
  if (++kind.lines > kLinesPerSecond) {
    kind.last = text.substr(0, kTelling);
    return;
  }
  if (text.size() <= kLongest) return out_->log(message);
  const std::string shorter = std::string(text.substr(0, kLongest)) + " ...";
  spdlog::details::log_msg cut(message.time, message.source, message.logger_name, message.level, shorter);
  out_->log(cut);
}

}  // namespace trivela::nodes
