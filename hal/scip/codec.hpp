#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trivela::hal::scip {

/// SCIP 2.0 sends a number as characters: groups of 6 bits, the most significant first, each + 0x30. Source: Hokuyo,
/// Communication Protocol Specification For SCIP2.0 Standard (C-42-03320B), section 6.
inline constexpr char kFirstCharacter = 0x30;
inline constexpr char kLastCharacter = 0x6f;

/// Steps of a revolution have four digits.
inline constexpr int kLastStep = 9999;

/// Coded characters in a line of data, without the sum.
inline constexpr std::size_t kBlock = 64;

/// `value` in so many characters, 1 to 5; bits that do not fit are cut off.
std::string encode(std::uint32_t value, std::size_t characters);

/// The number of 1 to 5 characters; none for another length and for a character that the coding does not have.
std::optional<std::uint32_t> decode(std::string_view text);

/// Decodes one value after the other, `characters` each, 1 to 5. None where a character is not of the coding, or some
/// are left over. The sums of the blocks must be taken off before: a value may straddle two blocks.
std::optional<std::vector<std::uint32_t>> decode_all(std::string_view data, std::size_t characters);

/// The sum that closes a line: the low 6 bits of the sum of its bytes, + 0x30.
char checksum(std::string_view text);

}  // namespace trivela::hal::scip
