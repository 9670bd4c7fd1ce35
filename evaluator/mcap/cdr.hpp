#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace trivela::evaluator::mcap {

/// A message in CDR, little endian (XCDR1, as ROS 2 has it): a header of four bytes, then members in their order, each
/// aligned to its size from the header's end.
class Cdr {
 public:
  static_assert(std::endian::native == std::endian::little);

  /// Begins another message; what bytes() gave is gone.
  void begin() { bytes_.assign("\0\1\0\0", 4); }

  /// A whole number, a number or a bool.
  template <class Number>
  void put(Number number) {
    align(sizeof(number));
    char raw[sizeof(number)];
    std::memcpy(raw, &number, sizeof(number));
    bytes_.append(raw, sizeof(number));
  }

  /// Its length with the 0 at its end, then both.
  void put_text(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size() + 1));
    bytes_.append(text);
    bytes_ += '\0';
  }

  /// Of a sequence whose members follow.
  void put_length(std::size_t length) { put(static_cast<std::uint32_t>(length)); }

  std::string_view bytes() const { return bytes_; }

 private:
  void align(std::size_t size) { bytes_.append((size - (bytes_.size() - 4) % size) % size, '\0'); }

  std::string bytes_;
};

}  // namespace trivela::evaluator::mcap
