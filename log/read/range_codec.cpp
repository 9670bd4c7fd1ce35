#include "log/write/scan_log.hpp"

namespace trivela::log {

std::vector<std::uint8_t> encode_ranges(std::span<const std::uint32_t> range_mm) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(2 * range_mm.size());
  std::uint32_t before = 0;
  for (const std::uint32_t range : range_mm) {
    const std::uint32_t difference = range - before;
    const bool negative = (difference >> 31) != 0;
    std::uint32_t zigzag = (difference << 1) ^ (negative ? ~std::uint32_t{0} : 0);
    for (; zigzag > 0x7F; zigzag >>= 7) bytes.push_back(static_cast<std::uint8_t>(zigzag | 0x80));
    bytes.push_back(static_cast<std::uint8_t>(zigzag));
    before = range;
  }
  return bytes;
}

std::optional<std::vector<std::uint32_t>> decode_ranges(std::span<const std::uint8_t> bytes) {
  std::vector<std::uint32_t> range_mm;
  range_mm.reserve(bytes.size());
  std::uint32_t range = 0;
  std::uint64_t zigzag = 0;
  int shift = 0;
  for (const std::uint8_t byte : bytes) {
    if (shift > 28) return std::nullopt;
    zigzag |= static_cast<std::uint64_t>(byte & 0x7F) << shift;
    shift += 7;
    if ((byte & 0x80) != 0) continue;
    if (zigzag > 0xFFFFFFFF) return std::nullopt;
    const auto folded = static_cast<std::uint32_t>(zigzag);
    range += (folded >> 1) ^ ((folded & 1) != 0 ? ~std::uint32_t{0} : 0);
    range_mm.push_back(range);
    zigzag = 0;
    shift = 0;
  }
  if (shift != 0) return std::nullopt;
  return range_mm;
}

}  // namespace trivela::log
