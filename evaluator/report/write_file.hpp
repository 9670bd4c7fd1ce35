#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace trivela::evaluator {

/// Writes a text file anew. Throws std::runtime_error naming it, and the reason, where that fails.
void write_file(const std::filesystem::path& path, const std::string& text);

/// Writes a text file whole or not at all: beside its place, where `check` may throw on it, then in its place.
/// Throws std::runtime_error "cannot write `what` PATH", and what `check` throws.
void replace_file(const std::filesystem::path& path, const std::string& text, const std::string& what,
                  const std::function<void(const std::filesystem::path&)>& check = {});

}  // namespace trivela::evaluator
