#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace trivela::evaluator::log {

/// Ranges as bytes: the difference of each beam to the one before (modulo 2^32; the first to 0), zigzag (0, -1, 1, -2,
/// ... become 0, 1, 2, 3, ...), as a variable-length integer of 7 bits a byte, low first, high bit set on all but the
/// last. A smooth scene takes 1 to 2 bytes a beam. Lossless for every value.
std::vector<std::uint8_t> encode_ranges(std::span<const std::uint32_t> range_mm);

/// None: the bytes end inside a number, or a number has more than 32 bits.
std::optional<std::vector<std::uint32_t>> decode_ranges(std::span<const std::uint8_t> bytes);

}  // namespace trivela::evaluator::log
