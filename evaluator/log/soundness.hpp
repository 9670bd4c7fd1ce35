#pragma once

#include "evaluator/log/log_file.hpp"

namespace trivela::evaluator::log {

/// Makes sure that every text of a match log has the SHA-256 that it is named by, and that every session's
/// configuration and definition of messages are there. Throws std::runtime_error naming the file and what is damaged.
void check_texts(const LogFile& file);

/// The rows that the log's digests cover; nothing is compared.
Verification unverified(const LogFile& file);

/// Compares each session's rows with their digest. Throws std::runtime_error naming the session whose rows are not
/// those that were recorded, a session that has ended without a digest, or a table with rows of no session.
Verification verify(const LogFile& file);

}  // namespace trivela::evaluator::log
