#include "evaluator/imports/zip_file.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <stdexcept>
#include <string_view>

namespace trivela::evaluator::imports {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kEndBytes = 22, kDirectoryBytes = 46, kHeaderBytes = 30, kMostComment = 65535;
constexpr std::string_view kEndMark = "PK\5\6", kDirectoryMark = "PK\1\2", kHeaderMark = "PK\3\4";
constexpr std::uint32_t kMostOfEntry_B = 256U << 20;  // a team's log of a match has some 100 MB
constexpr std::uint16_t kStored = 0, kDeflated = 8;

/// Little-endian numbers at their places in a piece of the archive.
std::uint16_t u16(std::string_view bytes, std::size_t at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned>(static_cast<unsigned char>(bytes[at + i])); };
  return static_cast<std::uint16_t>(byte(0) | byte(1) << 8);
}
std::uint32_t u32(std::string_view bytes, std::size_t at) {
  return u16(bytes, at) | static_cast<std::uint32_t>(u16(bytes, at + 2)) << 16;
}

[[noreturn]] void fail_zip(const fs::path& archive, const std::string& why) {
  throw std::runtime_error(fmt::format("{}: no zip archive that can be read: {}", archive.string(), why));
}

/// `n` bytes from `offset`; fewer where the file ends.
std::string piece(std::ifstream& in, std::uint64_t offset, std::size_t n) {
  std::string bytes(n, '\0');
  in.clear();
  in.seekg(static_cast<std::streamoff>(offset));
  in.read(bytes.data(), static_cast<std::streamsize>(n));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  return bytes;
}

/// The record at the archive's end that says where its directory is.
std::string end_record(std::ifstream& in, const fs::path& archive, std::uint64_t size) {
  const std::size_t tail_bytes = static_cast<std::size_t>(std::min<std::uint64_t>(size, kEndBytes + kMostComment));
  const std::string tail = piece(in, size - tail_bytes, tail_bytes);
  const auto place = tail.rfind(kEndMark);
  if (place == std::string::npos || tail.size() - place < kEndBytes)
    fail_zip(archive, "it has no directory at its end, so it was cut off");
  return tail.substr(place, kEndBytes);
}

ZipEntry entry_of(std::string_view directory, std::size_t at, const fs::path& archive) {
  if (directory.size() < at + kDirectoryBytes || directory.substr(at, 4) != kDirectoryMark)
    fail_zip(archive, "its directory is broken");
  ZipEntry entry{.name = {},
                 .compressed_bytes = u32(directory, at + 20),
                 .bytes = u32(directory, at + 24),
                 .crc32 = u32(directory, at + 16),
                 .method = u16(directory, at + 10),
                 .offset = u32(directory, at + 42)};
  entry.name = directory.substr(at + kDirectoryBytes, u16(directory, at + 28));
  if ((u16(directory, at + 8) & 1) != 0) fail_zip(archive, fmt::format("{} is encrypted", entry.name));
  if (entry.method != kStored && entry.method != kDeflated)
    fail_zip(archive, fmt::format("{} is packed by method {}, not stored or deflated", entry.name, entry.method));
  if (entry.bytes > kMostOfEntry_B || entry.offset == UINT32_MAX)
    fail_zip(archive, fmt::format("{} is larger than {} MB", entry.name, kMostOfEntry_B >> 20));
  return entry;
}

}  // namespace

bool is_zip(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string mark = piece(in, 0, 4);
  return mark == kHeaderMark || mark == kEndMark;
}

std::vector<ZipEntry> zip_entries(const fs::path& archive) {
  std::ifstream in(archive, std::ios::binary);
  const std::uint64_t size = fs::file_size(archive);
  const std::string end = end_record(in, archive, size);
  const std::uint64_t bytes = u32(end, 12), offset = u32(end, 16);
  if (offset + bytes > size) fail_zip(archive, "its directory lies beyond its end");
  const std::string directory = piece(in, offset, static_cast<std::size_t>(bytes));
  std::vector<ZipEntry> entries;
  std::size_t at = 0;
  for (int left = u16(end, 10); left > 0; --left) {
    entries.push_back(entry_of(directory, at, archive));
    at += kDirectoryBytes + std::size_t{u16(directory, at + 28)} + u16(directory, at + 30) + u16(directory, at + 32);
  }
  return entries;
}

class ZipStream::Buffer : public std::streambuf {
 public:
  Buffer(const fs::path& archive, const ZipEntry& entry) : in_(archive, std::ios::binary), entry_(entry) {
    const std::string header = piece(in_, entry.offset, kHeaderBytes);
    if (header.size() < kHeaderBytes || !header.starts_with(kHeaderMark))
      fail_zip(archive, fmt::format("{} is not where the directory has it", entry.name));
    in_.clear();
    in_.seekg(
        static_cast<std::streamoff>(std::uint64_t{entry.offset} + kHeaderBytes + u16(header, 26) + u16(header, 28)));
    left_ = entry.compressed_bytes;
    if (inflateInit2(&inflater_, -MAX_WBITS) != Z_OK) fail_zip(archive, "zlib does not start");
  }
  ~Buffer() override { inflateEnd(&inflater_); }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  const std::string& fault() const { return fault_; }

 protected:
  int_type underflow() override {
    if (!fault_.empty() || ended_) return traits_type::eof();
    const std::size_t n = entry_.method == kStored ? copy() : unpack();
    crc_ = ::crc32(crc_, reinterpret_cast<const Bytef*>(out_.data()), static_cast<uInt>(n));
    bytes_ += n;
    if (bytes_ > entry_.bytes && fault_.empty()) {
      fault_ = "it holds more than the archive's directory says";
      return traits_type::eof();
    }
    if (n == 0) {
      ended_ = true;
      if (fault_.empty() && (crc_ != entry_.crc32 || bytes_ != entry_.bytes))
        fault_ = "its bytes are not those that were packed";
      return traits_type::eof();
    }
    setg(out_.data(), out_.data(), out_.data() + n);
    return traits_type::to_int_type(out_[0]);
  }

 private:
  static constexpr std::size_t kPiece = 65536;

  /// Packed bytes into `to`; fewer than were asked for where entry or archive end.
  std::size_t take(char* to, std::size_t most) {
    in_.read(to, static_cast<std::streamsize>(std::min<std::uint64_t>(most, left_)));
    const auto n = static_cast<std::size_t>(in_.gcount());
    left_ -= n;
    if (n == 0 && left_ > 0) fault_ = "the archive ends within it";
    return n;
  }

  std::size_t copy() { return take(out_.data(), out_.size()); }

  std::size_t unpack() {
    inflater_.next_out = reinterpret_cast<Bytef*>(out_.data());
    inflater_.avail_out = static_cast<uInt>(out_.size());
    while (inflater_.avail_out == out_.size() && fault_.empty() && !stream_ended_) {
      if (inflater_.avail_in == 0) {
        inflater_.avail_in = static_cast<uInt>(take(packed_.data(), packed_.size()));
        inflater_.next_in = reinterpret_cast<Bytef*>(packed_.data());
      }
      const int code = inflate(&inflater_, Z_NO_FLUSH);
      stream_ended_ = code == Z_STREAM_END;
      if (code != Z_OK && !stream_ended_ && fault_.empty()) fault_ = "its packed bytes are broken";
    }
    return out_.size() - inflater_.avail_out;
  }

  std::ifstream in_;
  ZipEntry entry_;
  z_stream inflater_{};
  std::uint64_t left_ = 0, bytes_ = 0;
  uLong crc_ = 0;
  bool ended_ = false, stream_ended_ = false;
  std::string fault_;
  std::array<char, kPiece> packed_{}, out_{};
};

ZipStream::ZipStream(const fs::path& archive, const ZipEntry& entry)
    : std::istream(nullptr), buffer_(std::make_unique<Buffer>(archive, entry)) {
  rdbuf(buffer_.get());
}

ZipStream::~ZipStream() = default;

const std::string& ZipStream::fault() const { return buffer_->fault(); }

}  // namespace trivela::evaluator::imports
