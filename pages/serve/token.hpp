#pragma once

#include <filesystem>
#include <string>

namespace trivela::pages {

/// 32 hexadecimal digits that nobody can guess. Throws std::runtime_error where the kernel gives none.
std::string draw_token();

/// The first line of a file that its owner alone may read. Throws config::BadArgument naming the file where it cannot
/// be read, others may read it, or the line is not of 16 to 128 letters, digits, '-' and '_'.
std::string token_of_file(const std::filesystem::path& file);

/// Compares in a time that does not tell how much of it is right.
bool same_token(const std::string& given, const std::string& token);

/// The value of a cookie in a Cookie header; empty: it has none of the name.
std::string cookie_of(const std::string& header, const std::string& name);

}  // namespace trivela::pages
