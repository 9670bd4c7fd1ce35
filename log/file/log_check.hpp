#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace trivela::log {

/// How closely a log is looked at when it is opened.
enum class Check {
  kSchema,   ///< its schema alone, for who takes what is readable of a damaged file
  kQuick,    ///< its schema, its texts, and, of at most kShort_B, that its pages hang together
  kIfShort,  ///< everything, where that takes well under a second: files of at most kShort_B
  kWhole,    ///< everything: each index entry, and each row by its digest
};
inline constexpr std::uintmax_t kShort_B = 32 << 20;

/// What the digests of a match log say.
struct Verification {
  std::int64_t rows = 0;            ///< that digests cover
  std::int64_t without_digest = 0;  ///< sessions that never ended
  bool compared = false;            ///< the rows that digests cover are those that were recorded
};

/// Who is told, of every log that this program verifies: its path, rows that were compared, and of how many. Of the
/// whole program, since logs are opened in many places; none: nobody.
using VerificationWatch = std::function<void(const std::string& file, std::int64_t rows, std::int64_t all)>;
void watch_verification(VerificationWatch watch);

class LogFile;

/// Makes sure that every text of a match log has the SHA-256 that it is named by, and that every session's
/// configuration and definition of messages are there. Throws std::runtime_error naming the file and what is damaged.
void check_texts(const LogFile& file);

/// The rows that the log's digests cover; nothing is compared.
Verification unverified(const LogFile& file);

/// Whether the session has ended and its rows are those of its digest; of a version without digests, whether it has
/// ended. What cannot be read is not whole.
bool is_whole(const LogFile& file, std::int64_t session_id);

/// Compares each session's rows with their digest. Throws std::runtime_error naming the session whose rows are not
/// those that were recorded, a session that has ended without a digest, or a table with rows of no session.
Verification verify(const LogFile& file);

}  // namespace trivela::log
