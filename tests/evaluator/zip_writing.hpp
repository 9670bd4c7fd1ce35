#pragma once

#include <zlib.h>

#include <cstdint>
#include <string>
#include <vector>

namespace trivela::evaluator::imports {

struct PackedFile {
  std::string name;
  std::string text;
  bool deflated = true;
};

/// The bytes of a zip archive with these files.
inline std::string zip_of(const std::vector<PackedFile>& files) {
  const auto number = [](std::uint64_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i, value >>= 8) text += static_cast<char>(value & 0xFF);
    return text;
  };
  const auto deflated = [](const std::string& text) {
    z_stream deflater{};
    deflateInit2(&deflater, Z_DEFAULT_COMPRESSION, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
    std::string packed(deflateBound(&deflater, text.size()), '\0');
    deflater.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
    deflater.avail_in = static_cast<uInt>(text.size());
    deflater.next_out = reinterpret_cast<Bytef*>(packed.data());
    deflater.avail_out = static_cast<uInt>(packed.size());
    deflate(&deflater, Z_FINISH);
    packed.resize(deflater.total_out);
    deflateEnd(&deflater);
    return packed;
  };
  std::string archive, directory;
  for (const PackedFile& file : files) {
    const std::string packed = file.deflated ? deflated(file.text) : file.text;
    const auto* const bytes = reinterpret_cast<const Bytef*>(file.text.data());
    const std::string described = number(20, 2) + number(0, 2) + number(file.deflated ? 8 : 0, 2) + number(0, 4) +
                                  number(::crc32(0, bytes, static_cast<uInt>(file.text.size())), 4) +
                                  number(packed.size(), 4) + number(file.text.size(), 4) + number(file.name.size(), 2) +
                                  number(0, 2);
    directory += "PK\1\2" + number(20, 2) + described + number(0, 10) + number(archive.size(), 4) + file.name;
    archive += "PK\3\4" + described + file.name + packed;
  }
  return archive + directory + "PK\5\6" + number(0, 4) + number(files.size(), 2) + number(files.size(), 2) +
         number(directory.size(), 4) + number(archive.size(), 4) + number(0, 2);
}

}  // namespace trivela::evaluator::imports
