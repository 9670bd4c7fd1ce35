#include "hal/scip/codec.hpp"

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

}  // namespace trivela::hal::scip
