#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace trivela::cli {

/// A machine with match logs on it.
struct LogHost {
  std::string host;  ///< "robot3" or "user@robot3"
  std::string path;  ///< folder of logs, or one log, on that machine
};

/// What of a machine's logs is here.
struct Fetched {
  int logs = 0;                            ///< that the machine has
  int here = 0;                            ///< of these, whole and checked
  std::vector<std::string> being_written;  ///< names
  std::vector<std::string> missing;        ///< sentences: what is not here, and why
};

/// "HOST", "USER@HOST" or "HOST:PATH"; `folder`: the path of one that names none. Throws UsageError where host or path
/// is empty or could be taken for an option.
LogHost log_host(const std::string& text, const std::string& folder);

/// Throws std::runtime_error naming the program that $PATH does not have, and how one gets it.
void require_program(const std::string& name, const std::string& how);

/// Fetches every log *.db of the machine that nobody is writing into `to`/HOST, over `ssh`, and checks it there: its
/// size, and that it is a match log or scan record whose pages hang together. A log is being written where a -wal lies
/// beside it that changed within the last minute; an older -wal comes along with its log, whose recorder was killed.
/// What fails is said in the result, not thrown.
Fetched fetch_logs(const LogHost& host, const std::filesystem::path& to, const std::string& ssh);

}  // namespace trivela::cli
