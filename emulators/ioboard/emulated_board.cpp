#include "emulators/ioboard/emulated_board.hpp"

#include <algorithm>
#include <cstdlib>
#include <string_view>

namespace trivela::hal::ioboard {
namespace {

constexpr auto kPulseUnit_ns = static_cast<std::int64_t>(kPulseUnit_us * 1000.0);
// A start, as noise has it, and not enough bytes for a frame.
constexpr std::string_view kNoise{"\x00\x5A\xFF\x13\x5A\x08", 6};

}  // namespace

std::vector<std::string> EmulatedBoard::take(std::string_view bytes, std::int64_t now_ns) {
  std::vector<std::string> said;
  for (const Frame& question : parser_.feed(bytes)) {
    const std::string answered = spoil(encode(answer(question, now_ns)));
    if (!answered.empty()) said.push_back(answered);
  }
  return said;
}

/// As fast as the line carries.
std::vector<std::string> EmulatedBoard::tick(std::int64_t now_ns) {
  constexpr std::int64_t kPeriod_ns = 5'000'000;
  constexpr int kPieces = 10;  // 60 bytes in 5 ms at 115200 Bd
  next_noise_ns_ = now_ns + kPeriod_ns;
  std::string noise;
  for (int i = 0; i < kPieces; ++i) noise += kNoise;
  return {noise};
}

/// The board sends back the frame that it took, with what was asked for filled in.
Frame EmulatedBoard::answer(Frame question, std::int64_t now_ns) {
  if (faults.refuses) return {Command::kUnknown, question.payload};
  switch (question.command) {
    case Command::kShoot:
      shoot(question.payload[0], now_ns);
      break;
    case Command::kHeight:
      move_lever(question.payload[0], now_ns);
      break;
    case Command::kStatus:
      ++looks_;
      last_look_ns_ = now_ns;
      question.payload[0] = in_play ? 1 : 0;
      question.payload[1] = software_on ? 1 : 0;
      break;
    case Command::kVersion:
      std::ranges::copy(kEmulatedVersion, question.payload.begin());
      break;
    default:
      question.command = Command::kUnknown;
  }
  return question;
}

void EmulatedBoard::shoot(std::uint8_t units, std::int64_t now_ns) {
  ++shots_told_;
  if (now_ns < pulse_ends_ns_) return;
  pulses_.push_back({now_ns, units});
  pulse_ends_ns_ = now_ns + units * kPulseUnit_ns;
}

void EmulatedBoard::move_lever(std::uint8_t height, std::int64_t now_ns) {
  ++heights_told_;
  if (now_ns < lever_rests_ns_) return;
  lever_rests_ns_ = now_ns + std::abs(height - lever_) * kLeverStep_ns;
  lever_ = height;
}

bool EmulatedBoard::hit(int& left, int every) const {
  if (left > 0) return left-- > 0;
  return every > 0 && answers_ % static_cast<std::uint64_t>(every) == 0;
}

std::string EmulatedBoard::spoil(std::string answer) {
  ++answers_;
  if (faults.silent || hit(faults.lost, faults.lost_every)) return {};
  if (hit(faults.garbled, faults.garbled_every)) return std::string{kNoise};
  if (hit(faults.wrong_sums, faults.wrong_sums_every)) answer.back() = static_cast<char>(answer.back() ^ 0x01);
  return answer;
}

}  // namespace trivela::hal::ioboard
