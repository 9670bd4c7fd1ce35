#include "security/private_files.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace trivela::security {

void make_private_folder(const std::filesystem::path& folder) {
  if (folder.has_parent_path()) std::filesystem::create_directories(folder.parent_path());
  if (::mkdir(folder.c_str(), 0700) == 0 || errno == EEXIST) return;
  throw std::system_error{errno, std::generic_category(), folder.string()};
}

void write_private_file(const std::filesystem::path& file, const std::string& text) {
  const std::string unfinished = file.string() + ".new";
  const int descriptor = ::open(unfinished.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (descriptor < 0) throw std::system_error{errno, std::generic_category(), unfinished};
  const bool written = ::fchmod(descriptor, 0600) == 0 &&
                       ::write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
                       ::fsync(descriptor) == 0;
  const int reason = errno;
  ::close(descriptor);
  if (!written) throw std::system_error{reason, std::generic_category(), unfinished};
  std::filesystem::rename(unfinished, file);
}

std::string read_text(const std::filesystem::path& file) {
  constexpr std::uintmax_t kMost_B = 1 << 20;
  if (std::filesystem::exists(file) &&
      (!std::filesystem::is_regular_file(file) || std::filesystem::file_size(file) > kMost_B))
    throw std::runtime_error{fmt::format("{}: is no file of at most 1 MB: not read", file.string())};
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw std::runtime_error{fmt::format("{}: cannot be read", file.string())};
  return text.str();
}

}  // namespace trivela::security
