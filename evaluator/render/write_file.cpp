#include "evaluator/render/write_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "log/shards/study_results.hpp"

namespace trivela::evaluator {
namespace {

bool is_written(const std::filesystem::path& path, const std::string& text) {
  std::ofstream out{path, std::ios::binary};
  return (out << text) && out.flush();
}

/// Writes beside `path`, calls `check`, and renames: what stood there stays until the new text is whole.
/// False: errno says why, and nothing has changed. A pipe or device is written directly.
bool is_replaced(const std::filesystem::path& path, const std::string& text,
                 const std::function<void(const std::filesystem::path&)>& check) {
  namespace fs = std::filesystem;
  std::error_code unknown;
  const fs::file_status old = fs::status(path, unknown);
  if (fs::exists(old) && !fs::is_regular_file(old)) return is_written(path, text);
  fs::path place = fs::is_symlink(path, unknown) ? fs::weakly_canonical(path, unknown) : path;
  if (unknown) place = path;
  fs::path beside = place;
  beside += fmt::format(".{}.new", getpid());
  const auto discard = [&beside] {
    const int reason = errno;
    std::error_code ignored;
    fs::remove(beside, ignored);
    errno = reason;
  };
  try {
    if (is_written(beside, text)) {
      if (fs::exists(old)) fs::permissions(beside, old.permissions(), unknown);
      if (check) check(beside);
      if (std::rename(beside.c_str(), place.c_str()) == 0) return true;
    }
  } catch (...) {
    discard();
    throw;
  }
  discard();
  return false;
}

}  // namespace

void require_no_database(const std::string& what, const std::filesystem::path& path) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(path, unknown)) return;  // what is read of a pipe is gone
  std::string begin(log::kStudyResultsBegin.size(), '\0');
  std::ifstream{path, std::ios::binary}.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  const bool study = begin == log::kStudyResultsBegin;
  if (study || begin.starts_with("SQLite format 3"))
    throw std::runtime_error{fmt::format("{} {} holds {}, and is never overwritten; choose another file", what,
                                         path.string(), study ? "study results" : "a database, such as a match log")};
}

void write_file(const std::filesystem::path& path, const std::string& text) {
  require_no_database("the file", path);
  errno = 0;
  if (!is_replaced(path, text, {}))
    throw std::runtime_error{fmt::format("cannot write {}: {}", path.string(), std::strerror(errno))};
}

void replace_file(const std::filesystem::path& path, const std::string& text, const std::string& what,
                  const std::function<void(const std::filesystem::path&)>& check) {
  require_no_database(what, path);
  if (!is_replaced(path, text, check)) throw std::runtime_error{fmt::format("cannot write {} {}", what, path.string())};
}

}  // namespace trivela::evaluator
