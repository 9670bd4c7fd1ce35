#include "hal/scip/reply.hpp"

#include <algorithm>
#include <array>

namespace trivela::hal::scip {
namespace {

constexpr std::uint32_t kGroup = 0x3f;
constexpr std::size_t kMostCharacters = 5;  // 30 bits

}  // namespace

std::string encode(std::uint32_t value, std::size_t characters) {
  std::string text(characters, kFirstCharacter);
  for (std::size_t i = characters; i-- > 0; value >>= 6U)
    text[i] = static_cast<char>((value & kGroup) + kFirstCharacter);
  return text;
}

std::optional<std::uint32_t> decode(std::string_view text) {
  if (text.empty() || text.size() > kMostCharacters) return std::nullopt;
  std::uint32_t value = 0;
  for (const char character : text) {
    if (character < kFirstCharacter || character > kLastCharacter) return std::nullopt;
    value = value << 6U | static_cast<std::uint32_t>(character - kFirstCharacter);
  }
  return value;
}

std::optional<std::vector<std::uint32_t>> decode_all(std::string_view data, std::size_t characters) {
  if (characters == 0 || data.size() % characters != 0) return std::nullopt;
  std::vector<std::uint32_t> values;
  values.reserve(data.size() / characters);
  for (std::size_t at = 0; at < data.size(); at += characters) {
    const auto value = decode(data.substr(at, characters));
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

char checksum(std::string_view text) {
  std::uint32_t sum = 0;
  for (const char character : text) sum += static_cast<unsigned char>(character);
  return static_cast<char>((sum & kGroup) + kFirstCharacter);
}

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

namespace {

struct Meaning {
  std::string_view status;
  std::string_view text;
};

constexpr std::array kOfAnyRequest{
    Meaning{"00", "done"},
    Meaning{"0A", "the scanner cannot make an answer"},
    Meaning{"0B", "the scanner's buffer is full, or the request was repeated"},
    Meaning{"0C", "the request has too few parameters"},
    Meaning{"0D", "the scanner does not know the request"},
    Meaning{"0E", "the scanner does not know the request"},
    Meaning{"0F", "the request has too few parameters"},
    Meaning{"0G", "the request's text has more than 16 characters"},
    Meaning{"0H", "the request's text has characters that are not allowed"},
    Meaning{"0I", "the scanner waits for new firmware"},
};
constexpr std::array kOfMeasuring{
    Meaning{"01", "the start step is no number"},         Meaning{"02", "the end step is no number"},
    Meaning{"03", "the cluster count is no number"},      Meaning{"04", "the end step is out of range"},
    Meaning{"05", "the end step is before the start"},    Meaning{"06", "the scan interval is no number"},
    Meaning{"07", "the number of scans is no number"},    Meaning{"10", "the laser is off"},
    Meaning{"98", "the laser works again after a check"}, Meaning{"99", "a scan"},
};
constexpr std::array kOfLaser{
    Meaning{"01", "the laser does not work"},
    Meaning{"02", "the laser was on already"},
};

template <class Table>
std::string_view find(const Table& table, std::string_view status) {
  for (const Meaning& row : table) {
    if (row.status == status) return row.text;
  }
  return {};
}

}  // namespace

std::string meaning(std::string_view request, std::string_view status) {
  std::string_view text;
  if (request.starts_with("MD") || request.starts_with("GD")) {
    text = find(kOfMeasuring, status);
    if (text.empty() && status >= "21" && status <= "49") text = "the scanner stopped to look into a fault";
    if (text.empty() && status >= "50" && status <= "97") text = "the scanner has a fault in its hardware";
  } else if (request.starts_with("BM")) {
    text = find(kOfLaser, status);
  }
  if (text.empty()) text = find(kOfAnyRequest, status);
  return text.empty() ? "status " + std::string{status} : std::string{text};
}

}  // namespace trivela::hal::scip
