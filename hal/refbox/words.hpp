#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "hal/refbox/command.hpp"

namespace trivela::hal::refbox {

/// An object of the stream; the league allows less than 100 kB (RoboCup-MSL/RefBox, mslrb2015/Comms.pde).
struct Framed {
  std::string text;       ///< without its NUL; of an overlong one nothing
  bool overlong = false;  ///< it was longer than kLongestObject_B and is left out
};

inline constexpr std::size_t kLongestObject_B = 100'000;

/// Cuts a stream of bytes into the objects that a NUL ends: however many or few of them a read brings. It holds no more
/// than kLongestObject_B of an object, whatever comes. What is empty or blank between two NULs is no object.
class Framing {
 public:
  /// The objects that these bytes end, in their order.
  std::vector<Framed> add(std::string_view bytes);

  /// Bytes of an object that has not ended.
  std::size_t pending_bytes() const { return pending_.size(); }

 private:
  void extend(std::string_view part);

  std::string pending_;
  bool overlong_ = false;  // the object under way; its bytes are left out up to its NUL
};

/// What was said and is no command: it changes nothing.
struct NoCommand {
  std::string why;  ///< a clause for the log: "an object without a command: {"status":"connected"}"

  friend bool operator==(const NoCommand&, const NoCommand&) = default;
};

using ParsedCommand = std::variant<Command, NoCommand>;

/// A command of the league's JSON protocol: {"command":"KICKOFF","targetTeam":"224.16.32.39"}, keys in any order, with
/// "robotID" where it is about one robot, "emulated" where our own program says WELCOME. `group` is our team's
/// multicast group. A target that is empty or missing is both teams, our group is ours, also with the ":1" that a box
/// adds where a team plays itself; any other is theirs.
ParsedCommand read_object(std::string_view object, std::string_view group);

/// A command of the protocol before 2016, one letter.
ParsedCommand read_letter(char letter, Colour ours);

/// Which of them the box speaks.
enum class Protocol : std::uint8_t { kJson, kLetters };

/// What a team is called on the wire.
struct TeamMarks {
  Protocol protocol = Protocol::kJson;
  std::string group;  ///< multicast group, "224.16.32.39"
  Colour colour = Colour::kCyan;
};

/// The words in a stream of bytes; one for each connection.
class CommandStream {
 public:
  explicit CommandStream(TeamMarks team) : team_(std::move(team)) {}

  /// The words that these bytes end, in their order. None of those that follow an object where letters are spoken: the
  /// letters of its text are commands, too, a START among them.
  std::vector<ParsedCommand> add(std::string_view bytes);

  /// What is to be set otherwise, where the box speaks objects to who hears letters; nothing that it says counts then.
  std::optional<std::string_view> wrong_protocol() const;

 private:
  std::vector<ParsedCommand> letters(std::string_view bytes);
  /// Once a connection: that it begins with no object.
  std::optional<ParsedCommand> no_object(std::string_view bytes);

  TeamMarks team_;
  bool begun_ = false;
  bool objects_for_letters_ = false;
  Framing framing_;
};

}  // namespace trivela::hal::refbox
