#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace trivela::hal::scip {

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
