#include "log/file/reading_folder.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <ctime>
#include <string>
#include <string_view>
#include <system_error>

namespace trivela::log {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kName = "trivela_reading_";
constexpr std::time_t kYoung_s = 60;  // its program may not have taken the lock yet

/// Takes the lock of a folder; it ends with the process, whatever ends that. -1: it cannot be taken.
int hold(const fs::path& folder) {
  const int held = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC | O_NOFOLLOW);
  if (held < 0 || ::flock(held, LOCK_EX | LOCK_NB) == 0) return held;
  ::close(held);
  return -1;
}

bool is_old_and_own(const fs::path& folder) {
  struct stat found {};
  return ::lstat(folder.c_str(), &found) == 0 && S_ISDIR(found.st_mode) && found.st_uid == ::geteuid() &&
         std::time(nullptr) - found.st_mtime > kYoung_s;
}

void remove_whole(const fs::path& folder) {
  std::error_code ignored;
  fs::remove_all(folder, ignored);
}

void remove_left_behind(const fs::path& temporary) {
  std::error_code error;
  for (fs::directory_iterator at(temporary, error); !error && at != fs::directory_iterator(); at.increment(error)) {
    if (!at->path().filename().string().starts_with(kName) || !is_old_and_own(at->path())) continue;
    const int held = hold(at->path());
    if (held < 0) continue;
    remove_whole(at->path());
    ::close(held);
  }
}

}  // namespace

ReadingFolder::ReadingFolder() {
  const fs::path temporary = fs::temp_directory_path();
  remove_left_behind(temporary);
  std::string folder = (temporary / kName).string() + "XXXXXX";
  if (::mkdtemp(folder.data()) == nullptr) throw std::system_error(errno, std::generic_category(), temporary.string());
  path_ = folder;
  held_ = hold(path_);
}

ReadingFolder::~ReadingFolder() {
  remove_whole(path_);
  if (held_ >= 0) ::close(held_);
}

}  // namespace trivela::log
