#include "hal/mti/mti.hpp"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <utility>

#include "kicking/geometry/time.hpp"

namespace trivela::hal::mti {
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
