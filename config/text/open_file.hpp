#pragma once

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "kicking/text/bounded_text.hpp"

namespace trivela::config {

/// Why a file cannot be read, and where a relative name was looked for; empty if it can.
inline std::string why_unreadable(const std::filesystem::path& path) {
  std::error_code unknown;
  if (std::filesystem::is_directory(path, unknown)) return "it is a folder";
  errno = 0;
  if (std::ifstream{path}) return "";
  const std::string where =
      path.is_relative() ? fmt::format(" (in {})", std::filesystem::current_path(unknown).string()) : "";
  return std::strerror(errno) + where;
}

/// A file to read. Throws std::runtime_error with its name and the reason.
inline std::ifstream open_file(const std::filesystem::path& path) {
  if (const std::string why = why_unreadable(path); !why.empty())
    throw std::runtime_error{fmt::format("cannot read {}: {}", path.string(), why)};
  return std::ifstream{path, std::ios::binary};
}

using kicking::get_line;
using kicking::read_text;

/// read_text() of a file. Throws as open_file(), too.
inline std::string read_text_file(const std::filesystem::path& path,
                                  std::size_t most_bytes = kicking::kMostBytesOfText) {
  std::ifstream in = open_file(path);
  return read_text(in, path.string(), most_bytes);
}

}  // namespace trivela::config
