#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
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

/// What a scanner answered. All sums fitted and are taken off.
struct Reply {
  std::string echo;                       ///< the request, as the scanner understood it
  std::string status;                     ///< two characters
  std::vector<std::string> lines;         ///< "KEY:value" of VV, PP and II
  std::optional<std::uint32_t> stamp_ms;  ///< 24 bit, of MD and GD with data
  std::string data;                       ///< of MD and GD: the blocks, joined
};

/// How a reply came to grief.
enum class Damage {
  kNone,
  kTorn,      ///< lines are missing, or of another form than the protocol's
  kWrongSum,  ///< a checksum does not fit its line
};

/// Damaged replies.
struct Damages {
  std::uint64_t torn = 0;
  std::uint64_t wrong_sums = 0;
};

/// Reads the lines of one reply, each with its line feed, without the empty line at the end.
Damage read_reply(std::string_view text, Reply& reply);

/// From bytes, in pieces of any size, to replies. A damaged reply is counted once and left out; what follows the next
/// empty line, or of a line that ends with the damaged reply's echo, is read again. Holds kLongestReply bytes at
/// most.
class ReplyParser {
 public:
  static constexpr std::size_t kLongestLine = 256;
  static constexpr std::size_t kLongestReply = 65536;  ///< 10000 beams of 3 characters take half of it

  /// The replies that these bytes complete.
  std::vector<Reply> feed(std::string_view bytes);

  /// What was damaged since the last call.
  Damages take_damages() { return std::exchange(damages_, {}); }

 private:
  void end_line(std::vector<Reply>& replies);
  void end_reply(std::vector<Reply>& replies);
  void skip();

  std::string text_;            // of the reply under way
  std::size_t line_start_ = 0;  // of its last line
  bool line_empty_ = true;
  bool skipping_ = false;  // until the next empty line
  Damages damages_;
};

/// What the status of a reply to `request` means, as a clause: "the end step is out of range". Of an unknown one its
/// two characters. Source: Hokuyo, C-42-03320B, sections 8 and 9.
std::string meaning(std::string_view request, std::string_view status);

}  // namespace trivela::hal::scip
