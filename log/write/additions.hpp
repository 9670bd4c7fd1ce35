#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace trivela::log {

/// What may be said of a kick by hand: the observer's outcomes, "goal" and "saved" of one on target, and "outside" of a
/// miss that is not said how.
inline constexpr std::array<std::string_view, 12> kLabels = {"on_target", "wide_left", "wide_right", "over",
                                                             "short",     "post",      "bar",        "blocked",
                                                             "outside",   "unknown",   "goal",       "saved"};

/// What notes are about.
inline constexpr std::array<std::string_view, 4> kNoteKinds = {"match", "opponent", "venue", "note"};

/// What was to be added is none: the sentence says why.
struct BadAddition : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What somebody says of a kick: a row of table `labels`.
struct Label {
  std::int64_t session_id = 0;
  int robot_id = 0;
  std::int64_t kick_id = 0;
  std::int64_t t_ns = 0;               ///< of the decision
  std::optional<std::string> outcome;  ///< of kLabels; none: what was said before is withdrawn
  std::string who;
  std::string note;
};

/// What somebody says of a session: a row of table `notes`.
struct Note {
  std::int64_t session_id = 0;
  std::string kind;                 ///< of kNoteKinds
  std::optional<std::string> text;  ///< none: what was said of this kind before is withdrawn
  std::string who;
};

/// UTC since 1970.
inline std::int64_t utc_now_ns() {
  return std::chrono::nanoseconds{std::chrono::system_clock::now().time_since_epoch()}.count();
}

/// A match log that people add rows to. Nothing that is there is changed: every row is added in one transaction, behind
/// those of the same kick or kind by its time, and no digest covers it. A recorder or readers may be at work on the
/// file.
class Additions {
 public:
  /// Throws std::runtime_error naming the path where it is no match log, is damaged, of another version
  /// than kMatchLog, or cannot be written.
  explicit Additions(const std::filesystem::path& path);

  /// Throws BadAddition where a label is none of kLabels, a kind none of kNoteKinds,
  /// nobody says so, a text is too long or no UTF-8, std::runtime_error where the file refuses it: nothing is added
  /// then.
  void add(const Label& label, std::int64_t now_utc_ns);
  void add(const Note& note, std::int64_t now_utc_ns);

 private:
  template <class... Values>
  void add_row(const char* sql, const Values&... values);

  std::string path_;
  std::unique_ptr<SQLite::Database> database_;
};

}  // namespace trivela::log
