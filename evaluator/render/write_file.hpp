#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace trivela::evaluator {

/// Throws std::runtime_error naming `what` and the path, which may be a link, where a file there is one of
/// SQLite, or has study results.
void require_no_database(const std::string& what, const std::filesystem::path& path);

/// Writes a text file again. Throws std::runtime_error naming it, and the reason, where that fails, and what
/// require_no_database() throws.
void write_file(const std::filesystem::path& path, const std::string& text);

/// Writes a text file whole or not at all: beside its place, where `check` may throw on it, then in its place.
/// Throws std::runtime_error "cannot write `what` PATH", and what `check` and require_no_database() throw.
void replace_file(const std::filesystem::path& path, const std::string& text, const std::string& what,
                  const std::function<void(const std::filesystem::path&)>& check = {});

}  // namespace trivela::evaluator
