#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace trivela::config {

/// Bytes of the UTF-8 character that `text` begins with (RFC 3629: no overlong form, surrogate, or code point over
/// U+10FFFF); 0: it begins with none.
inline std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (text.empty()) return 0;
  const unsigned char lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t length = lead < 0xC2 ? 0 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : lead < 0xF5 ? 4 : 0;
  if (length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    const unsigned char low = i > 1 ? 0x80 : lead == 0xE0 ? 0xA0 : lead == 0xF0 ? 0x90 : 0x80;
    const unsigned char high = i > 1 ? 0xBF : lead == 0xED ? 0x9F : lead == 0xF4 ? 0x8F : 0xBF;
    if (byte(i) < low || byte(i) > high) return 0;
  }
  return length;
}

/// U+0000 to U+001F but the tab, U+007F, and U+0080 to U+009F: a terminal may obey them.
inline bool is_control(std::string_view character) {
  const auto first = static_cast<unsigned char>(character.front());
  if (first == 0xC2) return character.size() > 1 && static_cast<unsigned char>(character[1]) < 0xA0;
  return (first < 0x20 && first != '\t') || first == 0x7F;
}

/// Where `text` stops being one line of printable UTF-8; none: nowhere.
inline std::optional<std::size_t> first_unprintable(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text.substr(i));
    if (length == 0 || is_control(text.substr(i, length))) return i;
    i += length;
  }
  return std::nullopt;
}

}  // namespace trivela::config
