#include "hal/ioboard/frame.hpp"

#include <algorithm>

namespace trivela::hal::ioboard {
namespace {

constexpr char kStart = 0x5A;
constexpr std::size_t kLength = 11;

/// Of the command and payload that stand in `bytes` from `begin` on.
char sum_of(std::string_view bytes, std::size_t begin) {
  unsigned sum = 0;
  for (const char byte : bytes.substr(begin, kLength - 2)) sum += static_cast<unsigned char>(byte);
  return static_cast<char>(~sum & 0xFFU);
}

}  // namespace

Frame frame_of(Command command, std::uint8_t value) { return {command, {value, 0, 0, 0, 0, 0, 0, 0}}; }

std::string encode(const Frame& frame) {
  std::string bytes{kStart, static_cast<char>(frame.command)};
  bytes.append(frame.payload.begin(), frame.payload.end());
  bytes += sum_of(bytes, 1);
  return bytes;
}

std::vector<Frame> FrameParser::feed(std::string_view bytes) {
  bytes_ += bytes;
  std::vector<Frame> frames;
  std::size_t at = 0;
  for (;;) {
    const std::size_t start = std::min(bytes_.find(kStart, at), bytes_.size());
    stray_bytes_ += start - at;
    at = start;
    if (bytes_.size() - at < kLength) break;
    if (sum_of(bytes_, at + 1) != bytes_[at + kLength - 1]) {
      ++wrong_sums_;
      ++stray_bytes_;
      ++at;
      continue;
    }
    Frame frame{static_cast<Command>(bytes_[at + 1]), {}};
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(at) + 2, frame.payload.size(), frame.payload.begin());
    frames.push_back(frame);
    at += kLength;
  }
  bytes_.erase(0, at);
  return frames;
}

}  // namespace trivela::hal::ioboard
