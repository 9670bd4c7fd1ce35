#pragma once

#include <filesystem>
#include <string>

namespace trivela::security {

/// Makes a folder 0700, and those above it; leaves one alone that is there.
void make_private_folder(const std::filesystem::path& folder);

/// Writes a file 0600, whole or not at all. Throws std::system_error naming it.
void write_private_file(const std::filesystem::path& file, const std::string& text);

/// Throws std::runtime_error naming a file that cannot be read.
std::string read_text(const std::filesystem::path& file);

}  // namespace trivela::security
