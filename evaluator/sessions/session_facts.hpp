#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kicking/geometry/goal.hpp"
#include "log/read/reader.hpp"
#include "log/schema/queries.hpp"

namespace trivela::evaluator {

/// Numbers of what sessions were played with: the same number, the same text.
struct SessionSetup {
  std::uint32_t world = 0;     ///< the scenario, whatever its file is called
  std::uint32_t settings = 0;  ///< settings and robots, but for who is in charge of the kicks, and how long
};

/// Tells the configurations of a comparison's sessions apart.
class SetupIndex {
 public:
  /// `config` as table `texts` has it: "### settings", "### robot" and, of a simulated session, "### scenario".
  SessionSetup of(const std::string& config);

 private:
  using Numbers = std::map<std::string, std::uint32_t>;
  Numbers worlds_;
  Numbers settings_;
};

/// The field that a session was played on.
struct LoggedPitch {
  kicking::Goal goal{};
  double side_line_x_m = 6.0;
};

/// Out of [goal] and [field] of a session's configuration, as table `texts` has it; what it does not say stays as it is
/// by default.
LoggedPitch pitch_of(std::string_view config);

/// What somebody said of a session: a row of table `notes`.
struct SessionNote {
  std::int64_t session_id = 0;
  std::string uuid;
  std::string kind;         ///< match, opponent, venue, note
  std::int64_t utc_ns = 0;  ///< UTC since 1970
  std::string who;
  std::optional<std::string> text;  ///< none: what was said before is withdrawn
  bool holds = false;  ///< nothing later takes its place: another match, opponent or venue, or a withdrawal
};

/// By session, kind and time. Throws std::runtime_error where the log cannot be read.
std::vector<SessionNote> session_notes(const log::Reader& reader);

/// Those that hold, match, opponent and venue first; what is said of several sessions alike once.
std::vector<SessionNote> notes_that_hold(const std::vector<SessionNote>& notes);

/// "Opponent: Them", "Note of Ada, 2026-11-24 09:30 UTC: the left goal post leans".
std::string line_of(const SessionNote& note);

/// By session_id of an imported session: sentences on what it was imported from.
using ImportNotes = std::map<std::int64_t, std::vector<std::string>>;

/// Of the sessions whose configuration begins with log::kImportMark. Throws std::runtime_error where it cannot be read.
ImportNotes import_notes_of(const log::Queries& reader);

}  // namespace trivela::evaluator
