#pragma once

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

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

}  // namespace trivela::config
