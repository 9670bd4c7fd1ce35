#include <exception>

#include "log/file/log_check.hpp"

#include <fmt/format.h>

#include "log/file/log_file.hpp"
#include "log/file/session_tallies.hpp"
#include "log/schema/row_digest.hpp"

namespace trivela::log {
namespace {

[[noreturn]] void damaged(const LogFile& file, const std::string& what, Refused why = Refused::kDamaged) {
  throw RefusedLog(why, fmt::format("the match log {} is damaged or was changed: {}", file.path(), what));
}

void check_hashes(const LogFile& file, const std::string& pairs, const std::string& what) {
  file.query(pairs, [&](const std::string& named, const std::string& text) {
    if (const std::string is = sha256(text); is != named)
      damaged(file, fmt::format("{} named {:.64} has the SHA-256 {}", what, named, is));
  });
}

VerificationWatch& verification_watch() {
  static VerificationWatch watch;
  return watch;
}

struct DigestedSession {
  std::int64_t session_id = 0;
  std::string uuid;
  bool closed = false;
  std::optional<RowDigest> noted;
};

std::vector<DigestedSession> digested_sessions(const LogFile& file) {
  std::vector<DigestedSession> sessions;
  file.query(
      "SELECT s.session_id, s.uuid, s.closed_t_ns IS NOT NULL, d.row_count, d.sha256 FROM main.sessions AS s "
      "LEFT JOIN main.digests AS d USING (session_id) ORDER BY s.session_id",
      [&](std::int64_t session_id, const std::string& uuid, bool closed, std::optional<std::int64_t> row_count,
          std::optional<std::string> sha256) {
        DigestedSession& session = sessions.emplace_back(DigestedSession{session_id, uuid, closed, {}});
        if (row_count) session.noted = RowDigest{*row_count, std::move(sha256).value_or("")};
      });
  return sessions;
}

void check_that_rows_have_sessions(const LogFile& file) {
  const auto check = [&](std::string_view table) {
    file.query(fmt::format("SELECT session_id FROM main.{} WHERE session_id NOT IN (SELECT session_id FROM "
                           "main.sessions) LIMIT 1",
                           table),
               [&](std::int64_t) { damaged(file, fmt::format("{} has rows of no session", table)); });
  };
  for (const StreamTable& table : digested_tables()) check(table.name);
  check("digests");
}

}  // namespace

void watch_verification(VerificationWatch watch) { verification_watch() = std::move(watch); }

void check_texts(const LogFile& file) {
  check_hashes(file, "SELECT sha256, text FROM main.texts", "the text");
  check_hashes(file, "SELECT arguments_sha256, arguments FROM main.experiments", "the experiment's arguments");
  for (const char* const text : {"config_sha256", "idl_sha256"}) {
    file.query(
        fmt::format("SELECT uuid FROM main.sessions WHERE {} NOT IN (SELECT sha256 FROM main.texts) LIMIT 1", text),
        [&](const std::string& uuid) {
          damaged(file, fmt::format("the text that {} of session {} names is not there", text, uuid));
        });
  }
}

Verification unverified(const LogFile& file) {
  Verification found;
  file.query(
      "SELECT (SELECT coalesce(sum(row_count), 0) FROM main.digests), (SELECT count(*) FROM main.sessions WHERE "
      "session_id NOT IN (SELECT session_id FROM main.digests))",
      [&](std::int64_t rows, std::int64_t without_digest) {
        found.rows = rows;
        found.without_digest = without_digest;
      });
  return found;
}

bool is_whole(const LogFile& file, std::int64_t session_id) try {
  bool closed = false;
  file.query(fmt::format("SELECT closed_t_ns IS NOT NULL FROM main.sessions WHERE session_id = {}", session_id),
             [&](bool has_end) { closed = has_end; });
  if (!closed) return false;
  std::optional<RowDigest> noted;
  file.query(fmt::format("SELECT row_count, sha256 FROM main.digests WHERE session_id = {}", session_id),
             [&](std::int64_t row_count, const std::string& sha256) {
               noted = RowDigest{row_count, sha256};
             });
  return noted && RowDigests(file.database()).of(session_id) == *noted;
} catch (const std::exception&) {
  return false;
}

Verification verify(const LogFile& file) {
  Verification found = unverified(file);
  check_that_rows_have_sessions(file);
  std::int64_t before = 0;  // rows of sessions that were compared
  RowDigests digests(file.database());
  if (verification_watch())
    digests.tell([&](std::int64_t rows) { verification_watch()(file.path(), before + rows, found.rows); });
  for (const DigestedSession& session : digested_sessions(file)) {
    if (!session.noted && !session.closed) continue;
    if (!session.noted)
      damaged(file, fmt::format("session {} has ended, but the digest of its rows is not there", session.uuid));
    const RowDigest is = digests.of(session.session_id);
    before += is.row_count;
    if (is == *session.noted) continue;
    damaged(file, fmt::format("the rows of session {} are not those that were recorded ({} rows, digest {:.12}...; "
                              "recorded {} rows, digest {:.12}...)",
                              session.uuid, is.row_count, is.sha256, session.noted->row_count, session.noted->sha256));
  }
  if (const auto wrong = wrong_tallies(file); !wrong.empty()) damaged(file, wrong.front(), Refused::kWrongCounts);
  found.compared = true;
  return found;
}

}  // namespace trivela::log
