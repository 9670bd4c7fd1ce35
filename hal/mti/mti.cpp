#include "hal/mti/mti.hpp"

#include <fmt/core.h>

#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

#include "kicking/geometry/time.hpp"

namespace trivela::hal::mti {
namespace {

constexpr char kPreamble = static_cast<char>(0xFA), kBus = static_cast<char>(0xFF);
constexpr std::uint8_t kLongLength = 0xFF;
constexpr std::size_t kHead = 4, kLongHead = 6;  // up to the data
constexpr unsigned kSampleTimeFine = 0x1060, kRateOfTurn = 0x8020, kKind = 0xFFF0, kFormat = 0x3;
constexpr unsigned kFloat = 0, kDouble = 3;

std::uint8_t byte_at(std::string_view bytes, std::size_t i) { return static_cast<std::uint8_t>(bytes[i]); }

std::uint64_t big_endian(std::string_view bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) value = value << 8U | byte_at(bytes, i);
  return value;
}

void append(std::string& data, std::uint32_t value, unsigned size) {
  for (unsigned i = size; i-- > 0;) data += static_cast<char>(value >> (8 * i) & 0xFFU);
}

std::uint8_t sum_of(std::string_view bytes) {
  return std::accumulate(bytes.begin(), bytes.end(), std::uint8_t{0}, [](std::uint8_t sum, char byte) {
    return static_cast<std::uint8_t>(sum + static_cast<std::uint8_t>(byte));
  });
}

void take_rate(unsigned format, std::string_view data, Reading& reading) {
  const std::size_t size = format == kDouble ? 8 : 4;
  if ((format != kFloat && format != kDouble) || data.size() != 3 * size) {
    reading.fixed_point = true;
    return;
  }
  std::array<double, 3> rate_radps{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint64_t bits = big_endian(data.substr(i * size, size));
    rate_radps[i] = format == kDouble ? std::bit_cast<double>(bits)
                                      : static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
  }
  reading.rate_radps = rate_radps;
}

}  // namespace

std::string encode(const Message& message) {
  std::string bytes{kBus, static_cast<char>(message.id)};
  const bool is_long = message.data.size() >= kLongLength;
  if (is_long) bytes += static_cast<char>(kLongLength);
  append(bytes, static_cast<std::uint32_t>(message.data.size()), is_long ? 2 : 1);
  bytes += message.data;
  bytes += static_cast<char>(0x100 - sum_of(bytes));
  return kPreamble + bytes;
}

std::vector<Message> MessageParser::take(std::string_view bytes) {
  bytes_ += bytes;
  std::vector<Message> messages;
  while (auto message = next()) messages.push_back(std::move(*message));
  return messages;
}

std::optional<Message> MessageParser::next() {
  for (;;) {
    bytes_.erase(0, bytes_.find(kPreamble));
    if (bytes_.size() < 2) return std::nullopt;
    const auto pass_over = [this] { bytes_.erase(0, 1); };  // a preamble that is none
    if (bytes_[1] != kBus) {
      pass_over();
      continue;
    }
    if (bytes_.size() < kHead) return std::nullopt;
    const bool is_long = byte_at(bytes_, 3) == kLongLength;
    if (is_long && bytes_.size() < kLongHead) return std::nullopt;
    const std::size_t head = is_long ? kLongHead : kHead;
    const std::size_t size = is_long ? big_endian(std::string_view{bytes_}.substr(kHead, 2)) : byte_at(bytes_, 3);
    const bool possible = size <= kLongestData;
    if (possible && bytes_.size() < head + size + 1) return std::nullopt;
    if (!possible || sum_of(std::string_view{bytes_}.substr(1, head + size)) != 0) {
      pass_over();
      continue;
    }
    Message message{byte_at(bytes_, 2), bytes_.substr(head, size)};
    bytes_.erase(0, head + size + 1);
    return message;
  }
}

std::optional<Reading> reading_of(const Message& message) {
  if (message.id != kMtData2) return std::nullopt;
  Reading reading;
  for (std::string_view data = message.data; !data.empty();) {
    if (data.size() < 3 || data.size() < 3U + byte_at(data, 2)) return std::nullopt;
    const auto what = static_cast<unsigned>(big_endian(data.substr(0, 2)));
    const std::string_view part = data.substr(3, byte_at(data, 2));
    if ((what & kKind) == kSampleTimeFine && part.size() == 4)
      reading.sample_time = static_cast<std::uint32_t>(big_endian(part));
    if ((what & kKind) == kRateOfTurn) take_rate(what & kFormat, part, reading);
    data.remove_prefix(3 + part.size());
  }
  return reading;
}

Message message_of(const Reading& reading) {
  Message message{kMtData2, {}};
  if (reading.sample_time) {
    append(message.data, kSampleTimeFine, 2);
    append(message.data, 4, 1);
    append(message.data, *reading.sample_time, 4);
  }
  if (reading.rate_radps) {
    append(message.data, kRateOfTurn, 2);
    append(message.data, 12, 1);
    for (const double rate : *reading.rate_radps)
      append(message.data, std::bit_cast<std::uint32_t>(static_cast<float>(rate)), 4);
  }
  return message;
}

namespace {

constexpr std::int64_t kOpeningPause_ns = 200'000'000;
constexpr int kReadsAStep = 64;
constexpr unsigned kClockBits = 32;
constexpr Line::Deadline kWithoutWaiting{};

}  // namespace

Mti::Mti(std::unique_ptr<Line> line, const config::MtiDevice& settings)
    : line_(std::move(line)), sign_(settings.upside_down ? -1.0 : 1.0), status_("opening " + line_->name()) {}

void Mti::step(std::int64_t now_ns) {
  if (!open_ && now_ns >= next_open_ns_) open(now_ns);
  if (open_) receive(now_ns);
  if (open_ && now_ns - received_ns_ >= kSilence_ns) lose(why_without_samples(), now_ns);
}

std::string Mti::why_without_samples() const {
  if (other_message_)
    return fmt::format(
        "{}: message 0x{:02X} comes, but no measurement (MTData2, 0x36): the gyro is in configuration mode, or set up "
        "for another output",
        line_->name(), *other_message_);
  return fmt::format("{}: nothing came for {:g} s: the gyro is off, in configuration mode, or at another baud rate",
                     line_->name(), kicking::seconds(kSilence_ns));
}

std::int64_t Mti::next_ns() const { return open_ ? received_ns_ + kSilence_ns : next_open_ns_; }

void Mti::open(std::int64_t now_ns) {
  if (line_->open(kWithoutWaiting) != Line::Opening::kOpen)
    return lose(fmt::format("no gyro at {}: {}", line_->name(), line_->why()), now_ns);
  open_ = true;
  received_ns_ = now_ns;
  parser_ = {};
  other_message_.reset();
  clock_.emplace(Reading::kTick_ns, kClockBits, 0);
}

void Mti::receive(std::int64_t now_ns) {
  std::array<char, 512> bytes;
  for (int i = 0; i < kReadsAStep; ++i) {
    const auto count = line_->read(bytes, kWithoutWaiting);
    if (!count) return lose(fmt::format("{}: the line is cut: {}", line_->name(), line_->why()), now_ns);
    if (*count == 0) return;
    for (const Message& message : parser_.take({bytes.data(), *count})) {
      if (message.id != kMtData2) other_message_ = message.id;
      if (const auto reading = reading_of(message)) take(*reading, now_ns);
    }
  }
}

void Mti::take(const Reading& reading, std::int64_t now_ns) {
  received_ns_ = now_ns;
  const std::int64_t t_ns = reading.sample_time ? clock_->add(*reading.sample_time, now_ns).t_ns : now_ns;
  if (!reading.rate_radps) {
    status_ = fmt::format("{}: {}", line_->name(),
                          reading.fixed_point ? "the rate of turn (0x8020) is no float: set it to one"
                                              : "no rate of turn (0x8020) in what it says: switch it on");
    return;
  }
  const double rate_radps = sign_ * (*reading.rate_radps)[2];
  if (!std::isfinite(rate_radps)) return;
  newest_ = GyroSample{t_ns, rate_radps};
  status_ =
      line_->name() + ": MTi" + (reading.sample_time ? "" : ", without its sample time (0x1060): taken by arrival");
}

void Mti::lose(const std::string& why, std::int64_t now_ns) {
  line_->close();
  open_ = false;
  next_open_ns_ = now_ns + kOpeningPause_ns;
  status_ = why;
}

}  // namespace trivela::hal::mti
