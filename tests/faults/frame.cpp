#include "tests/faults/frame.hpp"

namespace trivela::faults {
namespace {

constexpr std::size_t kEthernet = 14;  // bytes of the header
constexpr std::size_t kUdp = 8;
constexpr std::size_t kChecksum = 6;  // in the UDP header
constexpr std::uint8_t kUdpProtocol = 17;

std::size_t word(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::size_t>(bytes[at]) << 8 | bytes[at + 1];
}

}  // namespace

std::optional<std::uint8_t> receiver_of(std::span<const std::uint8_t> frame) {
  if (frame.size() < kEthernet || (frame[0] & 1) != 0) return std::nullopt;
  return frame[5];
}

Frame udp_payload(Frame frame) {
  if (frame.size() < kEthernet + 20 + kUdp || word(frame, 12) != 0x0800) return {};
  const Frame ip = frame.subspan(kEthernet);
  const std::size_t header = static_cast<std::size_t>(ip[0] & 0xf) * 4;
  const bool fragment = (word(ip, 6) & 0x3fff) != 0;
  if (ip[0] >> 4 != 4 || ip[9] != kUdpProtocol || fragment || header < 20 || ip.size() < header + kUdp) return {};
  const std::size_t length = word(ip, header + 4);
  if (length < kUdp || ip.size() < header + length) return {};
  return ip.subspan(header + kUdp, length - kUdp);
}

bool garble(Frame frame, std::size_t most_bits, std::mt19937_64& random) {
  const Frame payload = udp_payload(frame);
  if (payload.empty() || most_bits == 0) return false;
  const std::size_t bits = 1 + random() % most_bits;
  for (std::size_t i = 0; i < bits; ++i) {
    const std::size_t bit = random() % (payload.size() * 8);
    payload[bit / 8] ^= static_cast<std::uint8_t>(1u << bit % 8);
  }
  std::uint8_t* const udp = payload.data() - kUdp;
  udp[kChecksum] = udp[kChecksum + 1] = 0;  // IPv4: none was made
  return true;
}

}  // namespace trivela::faults
