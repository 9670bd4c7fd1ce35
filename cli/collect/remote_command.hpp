#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace trivela::cli {

/// A program that ended.
struct Ran {
  bool succeeded = false;
  std::string output;  ///< standard output
  std::string said;    ///< standard error as one line, or how it ended
};

/// A word as a shell takes it back.
std::string shell_quoted(const std::string& word);

/// Runs a shell's command on a host by `ssh` without asking anybody for a password.
Ran run_on(const std::string& host, const std::string& command, const std::string& ssh);

/// rsync of files from a host into a folder: what is there already is compared by size and time, what came in part goes
/// on, nothing is changed there.
Ran fetch_files(const std::string& host, const std::vector<std::string>& paths, const std::filesystem::path& folder,
                const std::string& ssh);

}  // namespace trivela::cli
