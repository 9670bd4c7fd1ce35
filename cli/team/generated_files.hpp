#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/team/team_files.hpp"

namespace trivela::cli {

/// A file's text after a line, a comment of its kind (.xml or #), that has the digest of what follows.
std::string sealed(const config::TeamFile& file);

/// Whether a text is as sealed() made it.
bool is_sealed(const std::string& text);

/// The files in `folder` that are there and that are not as sealed() made one.
std::vector<std::filesystem::path> edited_files(const std::vector<config::TeamFile>& files,
                                                const std::filesystem::path& folder);

/// Writes the files sealed, each whole or not at all, and leaves one alone that is the same already. Returns the
/// written ones. Throws std::runtime_error naming the file.
std::vector<std::filesystem::path> write_sealed(const std::vector<config::TeamFile>& files,
                                                const std::filesystem::path& folder);

}  // namespace trivela::cli
