#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>
#include <memory>
#include <string>
#include <vector>

namespace trivela::evaluator::imports {

/// A file within a zip archive, as the archive's directory has it.
struct ZipEntry {
  std::string name;
  std::uint32_t compressed_bytes = 0;
  std::uint32_t bytes = 0;
  std::uint32_t crc32 = 0;
  std::uint16_t method = 0;  ///< 0: stored, 8: deflated
  std::uint32_t offset = 0;  ///< of its own header in the archive
};

/// An entry that is unpacked while it is read, some 64 kB at a time.
class ZipStream : public std::istream {
 public:
  /// Throws std::runtime_error naming archive and entry where it does not stand where the directory has it.
  ZipStream(const std::filesystem::path& archive, const ZipEntry& entry);
  ~ZipStream() override;

  /// What was wrong with the packed bytes, a checksum included; empty where all is well so far. Reading ends there.
  const std::string& fault() const;

 private:
  class Buffer;
  std::unique_ptr<Buffer> buffer_;
};

/// Does the file begin as zip archives do?
bool is_zip(const std::filesystem::path& path);

/// The files of an archive, in the order of its directory. Throws std::runtime_error naming the archive where it is cut
/// off, encrypted, of another method than stored and deflated, or larger than 4 GB. Format: APPNOTE of PKWARE, 4.3.
std::vector<ZipEntry> zip_entries(const std::filesystem::path& archive);

}  // namespace trivela::evaluator::imports
