#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace trivela::cli {

/// Writes a text file anew. Throws std::runtime_error naming it where that fails.
inline void write_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream out{path};
  if (!(out << text) || !out.flush()) throw std::runtime_error{"cannot write " + path.string()};
}

}  // namespace trivela::cli
