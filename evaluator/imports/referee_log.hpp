#pragma once

#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "evaluator/imports/fault_counter.hpp"
#include "idl/refbox/command.hpp"

namespace trivela::evaluator::imports {

using BoxCommand = refbox::CommandKind;

/// For whom: the box's left team is cyan (its log is `.A.msl`), the right one magenta (`.B.msl`).
enum class BoxSide { kBoth, kCyan, kMagenta };

constexpr BoxSide side_of(std::optional<refbox::Colour> team) {
  if (!team) return BoxSide::kBoth;
  return *team == refbox::Colour::kCyan ? BoxSide::kCyan : BoxSide::kMagenta;
}

/// A command of a log with its side; of one that was sent as JSON the side is that of its targetTeam.
struct SidedCommand {
  BoxCommand command{};
  BoxSide side = BoxSide::kBoth;
};

/// A command as the box logged it.
struct RefereeLine {
  std::int64_t line = 0;     ///< of the file, from 1
  std::int64_t t_ms = 0;     ///< UTC since 1970
  std::int64_t game_ms = 0;  ///< the box's clock of this part of the match, whole seconds
  std::int64_t run_ms = 0;   ///< of it the time that was played
  std::string state{};       ///< after the command, e.g. "1st Half - STOP"
  BoxCommand command{};
  BoxSide side = BoxSide::kBoth;  ///< kBoth also where a JSON command names a team whose side no line tells
  std::string text{};             ///< the box's words, e.g. "MAGENTA Kickoff"
};

/// The text log of a referee box.
struct RefereeLog {
  std::string file;
  std::vector<RefereeLine> lines;  ///< by their order in the file, t_ms never falling
  std::int64_t accepted = 0;       ///< connections of teams
  std::int64_t dropped = 0;        ///< and how many were lost
  std::int64_t refused = 0;        ///< base stations that were not let in
  FaultCounter faults;
};

/// Reads `ms,time(run time),state,code,text` line by line, code being a letter of the old protocol, a command's name or
/// the JSON object that was sent; between them stand connections. What cannot be read is counted in `faults`, as is a
/// time that goes back (it counts as its predecessor's), and the rest is used. Format: RoboCup-MSL/RefBox
/// mslrb2015/Log.pde, logs of 2018.
RefereeLog read_referee_log(std::istream& in, const std::string& file);

}  // namespace trivela::evaluator::imports
