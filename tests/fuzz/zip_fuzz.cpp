// Any bytes as a zip archive of logs: its directory is read or refused in words, and of every entry the first
// megabyte is unpacked or its fault named. Nothing is read that the archive does not hold.
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "evaluator/imports/zip_file.hpp"
#include "tests/fuzz/script.hpp"

namespace {

namespace fs = std::filesystem;
using namespace trivela::evaluator::imports;
using trivela::tests::require;

constexpr std::size_t kMost_B = 1'000'000, kMostEntries = 16;

/// A file that lies in memory alone and goes with the object.
class FileInMemory {
 public:
  FileInMemory(const std::uint8_t* bytes, std::size_t size) : id_(::memfd_create("archive", MFD_CLOEXEC)) {
    require(id_ >= 0 && ::write(id_, bytes, size) == static_cast<ssize_t>(size));
  }
  ~FileInMemory() { ::close(id_); }
  FileInMemory(const FileInMemory&) = delete;
  FileInMemory& operator=(const FileInMemory&) = delete;
  fs::path path() const { return "/proc/self/fd/" + std::to_string(id_); }

 private:
  int id_;
};

void unpack(const fs::path& archive, const ZipEntry& entry) {
  ZipStream in(archive, entry);
  std::string text(kMost_B, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  const auto read_B = static_cast<std::size_t>(in.gcount());
  if (read_B == text.size()) return;
  require(in.eof());
  require(read_B == entry.bytes || !in.fault().empty());
  if (entry.method == 0) require(read_B <= fs::file_size(archive));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const FileInMemory archive(bytes, size);
  is_zip(archive.path());
  try {
    std::vector<ZipEntry> entries = zip_entries(archive.path());
    require(entries.size() <= size / 46);  // each has its place in the directory
    if (entries.size() > kMostEntries) entries.resize(kMostEntries);
    for (const ZipEntry& entry : entries) {
      require(entry.name.size() <= size && (entry.method == 0 || entry.method == 8));
      unpack(archive.path(), entry);
    }
  } catch (const std::runtime_error& refused) {
    require(std::string_view(refused.what()).find("no zip archive that can be read: ") != std::string_view::npos);
  }
  return 0;
}
