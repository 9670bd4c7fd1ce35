#include "log/write/additions.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sqlite3.h>

#include <algorithm>

#include "kicking/text/printable.hpp"
#include "log/file/files_beside.hpp"
#include "log/file/log_file.hpp"
#include "log/schema/bind.hpp"
#include "log/schema/schema.hpp"

namespace trivela::log {
namespace {

constexpr int kWait_ms = 5000;
constexpr std::size_t kLongestName_B = 200;
constexpr std::size_t kLongestText_B = 10'000;

void check_text(const char* what, std::string_view text, std::size_t longest_bytes) {
  if (text.size() > longest_bytes)
    throw BadAddition(fmt::format("{} has {} bytes, the most are {}", what, text.size(), longest_bytes));
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t length = kicking::utf8_length(rest);
    if (length == 0 || rest.front() == '\0') throw BadAddition(fmt::format("{} is no text in UTF-8", what));
    rest.remove_prefix(length);
  }
}

void check_who(std::string_view who) {
  if (who.find_first_not_of(" \t\n") == std::string_view::npos)
    throw BadAddition("somebody must say so: the name is empty");
  check_text("the name", who, kLongestName_B);
}

template <std::size_t n>
void check_word(const char* what, const std::array<std::string_view, n>& words, std::string_view word) {
  if (std::ranges::find(words, word) == words.end())
    throw BadAddition(fmt::format("{} '{}' is none of {}", what, kicking::printable(word), fmt::join(words, ", ")));
}

}  // namespace

Additions::Additions(const std::filesystem::path& path) : path_(path.string()) {
  const LogFile log(path, kMatchLog, Check::kQuick);
  refuse_wal_of_another(path, log.wal());
  try {
    database_ = std::make_unique<SQLite::Database>(path_, SQLite::OPEN_READWRITE, kWait_ms);
    sqlite3* const handle = database_->getHandle();
    for (const int off : {SQLITE_DBCONFIG_TRUSTED_SCHEMA, SQLITE_DBCONFIG_ENABLE_VIEW, SQLITE_DBCONFIG_ENABLE_TRIGGER})
      sqlite3_db_config(handle, off, 0, nullptr);
    if (sqlite3_db_readonly(handle, "main") == 1)
      throw std::runtime_error(fmt::format("cannot add to the match log {}: it may only be read", path_));
  } catch (const SQLite::Exception& error) {
    throw std::runtime_error(fmt::format("cannot add to the match log {}: {}", path_, error.what()));
  }
}

template <class... Values>
void Additions::add_row(const char* sql, const Values&... values) {
  try {
    SQLite::Transaction transaction(*database_, SQLite::TransactionBehavior::IMMEDIATE);
    run(*database_, sql, values...);
    transaction.commit();
  } catch (const SQLite::Exception& error) {
    throw std::runtime_error(fmt::format("cannot add to the match log {}: {}", path_, error.what()));
  }
}

void Additions::add(const Label& label, std::int64_t now_utc_ns) {
  if (label.outcome) check_word("the outcome", kLabels, *label.outcome);
  check_who(label.who);
  check_text("the note", label.note, kLongestText_B);
  // Behind what anybody said of the kick in any of its recordings, whatever this machine's clock says.
  add_row(
      "INSERT INTO main.labels (session_id, robot_id, kick_id, utc_ns, who, t_ns, outcome, note) "
      "VALUES (?1, ?2, ?3, max(?4, (SELECT coalesce(max(utc_ns) + 1, ?4) FROM main.labels WHERE "
      "robot_id = ?2 AND kick_id = ?3)), ?5, ?6, ?7, ?8)",
      label.session_id, label.robot_id, label.kick_id, now_utc_ns, label.who, label.t_ns, label.outcome, label.note);
}

void Additions::add(const Note& note, std::int64_t now_utc_ns) {
  check_word("the kind of note", kNoteKinds, note.kind);
  check_who(note.who);
  check_text("the note", note.text.value_or(""), kLongestText_B);
  add_row(
      "INSERT INTO main.notes (session_id, kind, utc_ns, who, text) VALUES (?1, ?2, max(?3, (SELECT "
      "coalesce(max(utc_ns) + 1, ?3) FROM main.notes WHERE session_id = ?1 AND kind = ?2)), ?4, ?5)",
      note.session_id, note.kind, now_utc_ns, note.who, note.text);
}

}  // namespace trivela::log
