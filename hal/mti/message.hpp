#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// What an Xsens MTi says: FA FF, a message's number, its length, its data (big endian) and a sum. Source:
/// jonlamb-gh/xsens-mti, README.md and src/.
namespace trivela::hal::mti {

inline constexpr std::uint8_t kMtData2 = 0x36;

struct Message {
  std::uint8_t id = 0;
  std::string data;
  bool operator==(const Message&) const = default;
};

std::string encode(const Message& message);

/// Messages out of the pieces in which they come; what is none is passed over.
class MessageParser {
 public:
  static constexpr std::size_t kLongestData = 2048;

  /// Those that are whole now.
  std::vector<Message> take(std::string_view bytes);

 private:
  std::optional<Message> next();

  std::string bytes_;  // not yet read
};

/// What of an MTData2 a turn rate needs.
struct Reading {
  static constexpr std::int64_t kTick_ns = 100'000;  ///< of sample_time

  std::optional<std::uint32_t> sample_time;         ///< 0x1060: ticks of its own clock, in 32 bits
  std::optional<std::array<double, 3>> rate_radps;  ///< 0x802_: about its own axes
  bool fixed_point = false;                         ///< its rate is there, but in a format that is not read
};

/// None: it is another message, or its parts do not fill it.
std::optional<Reading> reading_of(const Message& message);

/// A message that says it, with the rate as floats.
Message message_of(const Reading& reading);

}  // namespace trivela::hal::mti
