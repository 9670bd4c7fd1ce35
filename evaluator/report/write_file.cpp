#include "evaluator/report/write_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string_view>

namespace trivela::evaluator {
namespace {

bool is_written(const std::filesystem::path& path, const std::string& text) {
  std::ofstream out{path, std::ios::binary};
  return (out << text) && out.flush();
}

}  // namespace

void require_no_database(const std::string& what, const std::filesystem::path& path) {
  constexpr std::string_view kBegin = "SQLite format 3";
  std::string begin(kBegin.size(), '\0');
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(path, unknown)) return;  // what is read of a pipe is gone
  if (std::ifstream{path, std::ios::binary}.read(begin.data(), static_cast<std::streamsize>(begin.size())) &&
      begin == kBegin)
    throw std::runtime_error{
        fmt::format("{} {} holds a database, such as a match log, and is never overwritten; choose another file", what,
                    path.string())};
}

void write_file(const std::filesystem::path& path, const std::string& text) {
  require_no_database("the file", path);
  errno = 0;
  if (!is_written(path, text))
    throw std::runtime_error{fmt::format("cannot write {}: {}", path.string(), std::strerror(errno))};
}

void replace_file(const std::filesystem::path& path, const std::string& text, const std::string& what,
                  const std::function<void(const std::filesystem::path&)>& check) {
  require_no_database(what, path);
  std::filesystem::path beside = path;
  beside += fmt::format(".{}.new", getpid());
  std::error_code failed;
  try {
    if (!is_written(beside, text)) failed = std::make_error_code(std::errc::io_error);
    if (!failed && check) check(beside);
    if (!failed) std::filesystem::rename(beside, path, failed);
    if (failed) throw std::runtime_error{fmt::format("cannot write {} {}", what, path.string())};
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(beside, ignored);
    throw;
  }
}

}  // namespace trivela::evaluator
