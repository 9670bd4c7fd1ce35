#include "hal/scip/reply.hpp"

#include <algorithm>

#include "hal/scip/codec.hpp"

namespace trivela::hal::scip {
namespace {

// Takes the next line off `text`; none when there is no more.
std::optional<std::string_view> next_line(std::string_view& text) {
  if (text.empty()) return std::nullopt;
  const std::size_t end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return line;
}

// Takes the sum off the end of `line`.
Damage strip_sum(std::string_view& line) {
  if (line.size() < 2) return Damage::kTorn;
  const char sum = line.back();
  line.remove_suffix(1);
  return checksum(line) == sum ? Damage::kNone : Damage::kWrongSum;
}

Damage read_status(std::string_view line, std::string_view echo, std::string& status) {
  // A scanner that is asked for SCIP 2.0 while it speaks SCIP 1.1 answers in the old form: one character, no sum.
  if (line.size() == 1 && echo.starts_with("SCIP")) {
    status = "0" + std::string{line};
    return Damage::kNone;
  }
  if (line.size() != 3) return Damage::kTorn;
  const Damage damage = strip_sum(line);
  status = line;
  return damage;
}

// "KEY:value;" and the sum of what stands before the semicolon.
Damage read_text(std::string_view text, std::vector<std::string>& lines) {
  while (const auto line = next_line(text)) {
    if (line->size() < 3 || (*line)[line->size() - 2] != ';') return Damage::kTorn;
    const std::string_view content = line->substr(0, line->size() - 2);
    if (checksum(content) != line->back()) return Damage::kWrongSum;
    lines.emplace_back(content);
  }
  return Damage::kNone;
}

Damage read_scan(std::string_view text, Reply& reply) {
  auto stamp = next_line(text);
  if (!stamp) return Damage::kNone;  // the scanner accepts the request, or refuses
  if (stamp->size() != 5) return Damage::kTorn;
  if (const Damage damage = strip_sum(*stamp); damage != Damage::kNone) return damage;
  reply.stamp_ms = decode(*stamp);
  if (!reply.stamp_ms) return Damage::kTorn;
  reply.data.reserve(text.size());
  while (auto block = next_line(text)) {
    const bool last = text.empty();
    if (last ? block->size() > kBlock + 1 : block->size() != kBlock + 1) return Damage::kTorn;
    if (const Damage damage = strip_sum(*block); damage != Damage::kNone) return damage;
    reply.data += *block;
  }
  return Damage::kNone;
}

}  // namespace

Damage read_reply(std::string_view text, Reply& reply) {
  const auto printable = [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); };
  if (!std::ranges::all_of(text, printable)) return Damage::kTorn;  // whatever its sum says
  const auto echo = next_line(text);
  const auto status = next_line(text);
  if (!echo || !status || echo->size() < 2) return Damage::kTorn;
  reply.echo = *echo;
  if (const Damage damage = read_status(*status, *echo, reply.status); damage != Damage::kNone) return damage;
  const bool scan = echo->starts_with("MD") || echo->starts_with("GD");
  return scan ? read_scan(text, reply) : read_text(text, reply.lines);
}

std::vector<Reply> ReplyParser::feed(std::string_view bytes) {
  std::vector<Reply> replies;
  while (!bytes.empty()) {
    const std::size_t end = bytes.find('\n');
    const std::string_view piece = bytes.substr(0, end);
    if (!piece.empty()) line_empty_ = false;
    const bool too_long = text_.size() - line_start_ + piece.size() > kLongestLine;
    if (!skipping_ && (too_long || text_.size() + piece.size() >= kLongestReply)) skip();
    if (!skipping_) text_ += piece;
    if (end == std::string_view::npos) break;
    bytes.remove_prefix(end + 1);
    end_line(replies);
  }
  return replies;
}

void ReplyParser::end_line(std::vector<Reply>& replies) {
  if (line_empty_) return end_reply(replies);
  line_empty_ = true;
  if (skipping_) return;
  text_ += '\n';
  const std::string_view text = text_;
  const std::string_view echo = text.substr(0, text.find('\n') + 1);
  if (line_start_ > 0 && text.substr(line_start_).ends_with(echo)) {
    ++damages_.torn;  // the empty line got lost, and this is the next reply
    text_.resize(echo.size());
  }
  line_start_ = text_.size();
}

void ReplyParser::end_reply(std::vector<Reply>& replies) {
  if (!skipping_ && !text_.empty()) {
    Reply reply;
    const Damage damage = read_reply(text_, reply);
    if (damage == Damage::kNone) replies.push_back(std::move(reply));
    if (damage == Damage::kTorn) ++damages_.torn;
    if (damage == Damage::kWrongSum) ++damages_.wrong_sums;
  }
  skipping_ = false;
  text_.clear();
  line_start_ = 0;
}

void ReplyParser::skip() {
  ++damages_.torn;
  skipping_ = true;
  text_.clear();
  line_start_ = 0;
}

}  // namespace trivela::hal::scip
