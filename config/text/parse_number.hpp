#pragma once

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

namespace trivela::config {

/// The decimal number that a text is, sign, fraction and exponent included; "nan" and "inf" are ones. None: anything
/// else, blanks, or beyond a double.
inline std::optional<double> parse_decimal(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// A text in the grammar of the C library's strto* without its leading blanks, sign and hexadecimal prefix.
struct UnsignedText {
  explicit UnsignedText(std::string_view text) : digits(text) {
    digits.remove_prefix(std::min(digits.find_first_not_of(" \t\n\v\f\r"), digits.size()));
    negative = digits.starts_with('-');
    if (negative || digits.starts_with('+')) digits.remove_prefix(1);
    hexadecimal = digits.size() > 2 && (digits.starts_with("0x") || digits.starts_with("0X"));
    if (hexadecimal) digits.remove_prefix(2);
    if (digits.starts_with('-')) digits = {};  // from_chars would take it
  }

  std::string_view digits;
  bool negative = false;
  bool hexadecimal = false;
};

/// A number as flags take it: blanks before it, a sign, hexadecimal behind 0x. Beyond a double it is infinite, or 0.
inline std::optional<double> parse_number(std::string_view text) {
  const UnsignedText number{text};
  const char* const end = number.digits.data() + number.digits.size();
  long double value = 0.0L;  // rounded twice, as CLI11 reads an option's value
  const auto [stop, error] = std::from_chars(number.digits.data(), end, value,
                                             number.hexadecimal ? std::chars_format::hex : std::chars_format::general);
  if (error == std::errc::invalid_argument || stop != end) return std::nullopt;
  if (error == std::errc::result_out_of_range && number.digits.find('-') == std::string_view::npos)
    value = std::numeric_limits<long double>::infinity();
  return static_cast<double>(number.negative ? -value : value);
}

/// A whole number as flags take it: blanks before it, a sign, hexadecimal behind 0x, octal behind 0.
inline std::optional<std::int64_t> parse_integer(std::string_view text) {
  const UnsignedText number{text};
  const char* const end = number.digits.data() + number.digits.size();
  const int radix = number.hexadecimal ? 16 : number.digits.starts_with('0') ? 8 : 10;
  std::int64_t value = 0;
  const auto [stop, error] = std::from_chars(number.digits.data(), end, value, radix);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return number.negative ? -value : value;
}

}  // namespace trivela::config
