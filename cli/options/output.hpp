#pragma once

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "config/text/error.hpp"
#include "evaluator/render/write_file.hpp"
#include "kicking/text/printable.hpp"

namespace trivela::cli {

/// Lines for people, on standard output. Names in a log, a table or a path come from anybody: what a terminal could
/// obey is written as \xNN.
inline void say(std::string_view lines) { fmt::print("{}", kicking::printable_lines(lines)); }

/// A sentence on standard error, by the same rule.
inline void warn(std::string_view sentence) { fmt::print(stderr, "trivela: {}\n", kicking::printable_lines(sentence)); }

using evaluator::write_file;

/// What a verb will write when it has computed. The verb says so first, since nobody wants to hear after half an hour
/// that a folder is missing: throws std::runtime_error naming flag, file and reason where it cannot be written now. An
/// empty path is none. The file stays as it is, and one that was not there is not there afterwards. One that holds a
/// database is for verbs alone that write one, a `database`: a match log is never lost to a slip of the hand.
inline void require_writable(const std::string& flag, const std::filesystem::path& path, bool database = false) {
  if (path.empty()) return;
  if (!database) evaluator::require_no_database(flag, path);
  const auto fail = [&](const std::string& why) {
    throw std::runtime_error{fmt::format("cannot write {} {}: {}", flag, path.string(), why)};
  };
  std::error_code unknown;
  if (const auto folder = path.parent_path(); !folder.empty() && !std::filesystem::exists(folder, unknown) && !unknown)
    fail("there is no folder " + folder.string());
  const bool there = std::filesystem::exists(std::filesystem::symlink_status(path, unknown));
  if (std::filesystem::is_directory(path, unknown)) fail("it is a folder");
  if (there && !std::filesystem::is_regular_file(path, unknown)) return;  // a pipe, a terminal: opened once
  errno = 0;
  if (!std::ofstream{path, std::ios::app}) fail(std::strerror(errno));
  if (!there) std::filesystem::remove(path, unknown);
}

/// require_writable(), and that nothing is there that would be lost: throws config::BadArgument.
inline void require_new(const std::string& flag, const std::filesystem::path& path) {
  std::error_code unknown;
  const bool taken = std::filesystem::exists(path, unknown) && !(std::filesystem::is_regular_file(path, unknown) &&
                                                                 std::filesystem::file_size(path, unknown) == 0);
  if (taken)
    throw config::BadArgument{
        fmt::format("{} {} exists already and is never overwritten; choose another file", flag, path.string())};
  require_writable(flag, path);
}

}  // namespace trivela::cli
