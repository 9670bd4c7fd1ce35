#include "log/file/files_beside.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <ctime>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "log/file/new_file.hpp"

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

namespace fs = std::filesystem;

/// Source: sqlite.org/fileformat2.html, section 1.3: 1 for a rollback journal, 2 for a write-ahead log.
bool is_in_wal_mode(const fs::path& log) {
  constexpr std::size_t kReadVersion = 19;
  std::array<char, kReadVersion + 1> header{};
  std::ifstream in(log, std::ios::binary);
  return in.read(header.data(), header.size()) && header[kReadVersion] == 2;
}

bool exists_beside(const fs::path& log, const char* suffix) {
  std::error_code none;
  return fs::exists(beside(log, suffix), none);
}

/// Readers of a write-ahead log write their marks into the -shm.
bool can_be_read_in_place(const fs::path& log) {
  return exists_beside(log, "-shm") && ::access(beside(log, "-shm").c_str(), W_OK) == 0;
}

/// Its first bytes, which change when a recorder begins it again after it moved its rows into the log.
std::string start_of_wal(const fs::path& log) {
  constexpr std::size_t kHeader_B = 32;
  std::string start(kHeader_B, '\0');
  std::ifstream(beside(log, "-wal"), std::ios::binary).read(start.data(), kHeader_B);
  return start;
}

void copy_both(const fs::path& log, const fs::path& folder) {
  std::error_code error;
  constexpr int kAttempts = 5;
  for (int attempt = 0; attempt < kAttempts && !error; ++attempt) {
    const std::string start = start_of_wal(log);
    for (const char* const suffix : {"", "-wal"}) {
      const fs::path copy = folder / ("log.db" + std::string(suffix));
      if (!error) fs::copy_file(beside(log, suffix), copy, fs::copy_options::overwrite_existing, error);
      if (!error) fs::permissions(copy, fs::perms::owner_all, error);
    }
    if (!error && start_of_wal(log) == start) return;
  }
  throw std::runtime_error(error ? error.message() : "its recorder moves rows meanwhile; ask again");
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

Wal wal_beside(const fs::path& log) {
  const auto holds_rows = [&] {
    std::error_code none;
    const auto bytes = fs::file_size(beside(log, "-wal"), none);
    return !none && bytes > 0;
  };
  // Twice: whoever ends or goes on with a log meanwhile changes the one after the other.
  for (int look = 0; look < 2; ++look) {
    if (!holds_rows()) return Wal::kNone;
    if (is_in_wal_mode(log)) return Wal::kOfThis;
  }
  return Wal::kOfAnother;
}

void refuse_wal_of_another(const fs::path& log, Wal wal) {
  if (wal == Wal::kOfAnother)
    throw std::runtime_error(fmt::format("{0}-wal is not of {0} but of another recording: move it away", log.string()));
}

std::string name_of_main_file(const fs::path& log) {
  std::string name = "file:";
  for (const char c : fs::absolute(log).string()) {
    const bool plain = c != '%' && c != '?' && c != '#';
    plain ? name += c : name += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return name + "?immutable=1";
}

ReadableLog::ReadableLog(const fs::path& log) : log_(log), wal_(wal_beside(log)), name_(log.string()) {
  if (wal_ == Wal::kOfThis && can_be_read_in_place(log)) return;
  if (wal_ == Wal::kOfThis) {
    try {
      copied_to_.emplace();
      copy_both(log, copied_to_->path());
      name_ = (copied_to_->path() / "log.db").string();
      return;
    } catch (const std::exception& error) {
      copied_to_.reset();
      wal_ = wal_beside(log);
      if (wal_ == Wal::kOfThis)
        throw std::runtime_error(
            fmt::format("{} and its -wal cannot be copied to a folder for reading: {}", log.string(), error.what()));
    }  // its recorder has ended meanwhile
  }
  // One that a killed program left open needs its journal; one that a recorder has just emptied its -shm. To one that
  // has ended somebody may add meanwhile: SQLite's locks keep reading and writing apart.
  const bool ended = !is_in_wal_mode(log) && !exists_beside(log, "-wal");
  const bool in_use = ended || exists_beside(log, "-journal") || (wal_ == Wal::kNone && can_be_read_in_place(log));
  if (!in_use || wal_ == Wal::kOfAnother) name_ = name_of_main_file(log);
}

void ReadableLog::leave_wal_out() {
  wal_ = Wal::kOfAnother;
  name_ = name_of_main_file(log_);
}

}  // namespace trivela::log
