#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace trivela::kicking {

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

/// U+0000 to U+001F but the tab, U+007F, and U+0080 to U+009F: a terminal may obey them. U+061C, U+200E, U+200F,
/// U+2028 to U+202E and U+2066 to U+2069: they turn the direction of what follows, or end the line, unseen.
inline bool is_control(std::string_view character) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(character[i]); };
  if (character.size() == 1) return (byte(0) < 0x20 && byte(0) != '\t') || byte(0) == 0x7F;
  if (character.size() == 2) return (byte(0) == 0xC2 && byte(1) < 0xA0) || character == "\u061C";
  if (character.size() != 3 || byte(0) != 0xE2) return false;
  const unsigned char last = byte(2);
  if (byte(1) == 0x80) return last == 0x8E || last == 0x8F || (last >= 0xA8 && last <= 0xAE);
  return byte(1) == 0x81 && last >= 0xA6 && last <= 0xA9;
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

/// `text` as one line for a terminal: each byte of what is not printable as \xNN, everything else as it is.
inline std::string printable(std::string_view text) {
  static constexpr std::string_view kDigits = "0123456789abcdef";
  std::string line;
  while (const auto unprintable = first_unprintable(text)) {
    line += text.substr(0, *unprintable);
    text.remove_prefix(*unprintable);
    const std::size_t length = utf8_length(text) == 0 ? 1 : utf8_length(text);
    for (const char c : text.substr(0, length)) {
      const auto byte = static_cast<unsigned char>(c);
      line += "\\x";
      line += kDigits[byte >> 4];
      line += kDigits[byte & 15];
    }
    text.remove_prefix(length);
  }
  return line += text;
}

/// The same with the line feeds of `text`.
inline std::string printable_lines(std::string_view text) {
  std::string lines;
  while (true) {
    const std::size_t end = text.find('\n');
    lines += printable(text.substr(0, end));
    if (end == std::string_view::npos) return lines;
    lines += '\n';
    text.remove_prefix(end + 1);
  }
}

}  // namespace trivela::kicking
