#include "evaluator/report/write_file.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace trivela::evaluator {
namespace {

bool is_written(const std::filesystem::path& path, const std::string& text) {
  std::ofstream out{path, std::ios::binary};
  return (out << text) && out.flush();
}

}  // namespace

void write_file(const std::filesystem::path& path, const std::string& text) {
  errno = 0;
  if (!is_written(path, text))
    throw std::runtime_error{fmt::format("cannot write {}: {}", path.string(), std::strerror(errno))};
}

void replace_file(const std::filesystem::path& path, const std::string& text, const std::string& what,
                  const std::function<void(const std::filesystem::path&)>& check) {
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
