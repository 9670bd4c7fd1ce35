#include "tests/faults/rtps_writer.hpp"

#include <algorithm>
#include <charconv>

namespace trivela::faults {
namespace {

constexpr std::size_t kRtpsHeader = 20;  // magic, version, vendor, then 12 bytes of the participant
constexpr std::size_t kPrefixAt = 8;
constexpr std::size_t kPrefix = 12;
constexpr std::size_t kChecksumBefore = 2;  // of UDP, right before the payload

/// Where a submessage names its writer, from its own start; none: it is nobody's word.
std::optional<std::size_t> writer_at(std::uint8_t submessage) {
  switch (submessage) {
    case 0x15:  // DATA
    case 0x16:  // DATA_FRAG
      return 12;
    case 0x07:  // HEARTBEAT
    case 0x08:  // GAP
    case 0x13:  // HEARTBEAT_FRAG
      return 8;
    default:
      return std::nullopt;
  }
}

}  // namespace

std::optional<Guid> guid_of(std::string_view digits) {
  Guid guid{};
  if (digits.size() != 2 * guid.size()) return std::nullopt;
  for (std::size_t i = 0; i < guid.size(); ++i) {
    const char* const from = digits.data() + 2 * i;
    if (std::from_chars(from, from + 2, guid[i], 16).ptr != from + 2) return std::nullopt;
  }
  return guid;
}

bool mute(Frame frame, const Guid& writer) {
  const Frame payload = udp_payload(frame);
  if (payload.size() < kRtpsHeader ||
      !std::equal(writer.begin(), writer.begin() + kPrefix, payload.begin() + kPrefixAt))
    return false;
  bool muted = false;
  for (std::size_t at = kRtpsHeader; at + 4 <= payload.size();) {
    const bool little = (payload[at + 1] & 1) != 0;
    const std::size_t low = payload[at + (little ? 2 : 3)], high = payload[at + (little ? 3 : 2)];
    const std::size_t length = high << 8 | low;
    const auto place = writer_at(payload[at]);
    if (place && at + *place + 4 <= payload.size() &&
        std::equal(writer.begin() + kPrefix, writer.end(),
                   payload.begin() + static_cast<std::ptrdiff_t>(at + *place))) {
      std::fill_n(payload.begin() + static_cast<std::ptrdiff_t>(at + *place), 3, std::uint8_t{0xff});
      muted = true;
    }
    if (length == 0) break;  // the last one
    at += 4 + length;
  }
  if (muted) std::fill_n(payload.data() - kChecksumBefore, 2, std::uint8_t{0});
  return muted;
}

}  // namespace trivela::faults
