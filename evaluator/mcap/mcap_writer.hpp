#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace trivela::evaluator::mcap {

/// Appends a number as its bytes.
template <class Number>
void append(std::string& bytes, Number number) {
  char raw[sizeof(number)];
  std::memcpy(raw, &number, sizeof(number));
  bytes.append(raw, sizeof(number));
}

/// What the messages of a channel are, in ros2msg.
struct Schema {
  std::string name;  ///< "geometry_msgs/msg/PoseStamped"
  std::string text;
};

using Facts = std::map<std::string, std::string>;

/// Writes an MCAP file (mcap.dev/spec): messages in CDR, in chunks of about 1 MiB without compression, each with its
/// index, then a summary with statistics and indexes of chunks and metadata. Every CRC is there. Nothing depends on
/// clock or machine: the same calls make the same bytes. In memory is one chunk, and 40 bytes or so of each.
class Writer {
 public:
  /// `library`: who writes. Throws std::runtime_error naming the file, as all below.
  Writer(std::filesystem::path path, const std::string& library);

  /// Its number. A schema of the same name is taken for the same. Throws std::runtime_error beyond 65,535.
  std::uint16_t add_channel(const std::string& topic, const Schema& schema);

  /// A message at its instant.
  void write(std::uint16_t channel, std::uint32_t sequence, std::uint64_t t_ns, std::string_view message);

  /// What is true of the file, by a name.
  void add_metadata(const std::string& name, const Facts& facts);

  /// Ends the file; nothing is called afterwards.
  void close();

 private:
  struct ChunkIndex {
    std::uint64_t start_ns, end_ns, offset, length, records_B;
    std::map<std::uint16_t, std::uint64_t> indexes;  // offsets in the file, by channel
    std::uint64_t indexes_B;
  };
  struct MetadataIndex {
    std::uint64_t offset, length;
    std::string name;
  };

  void pour(std::string_view bytes);
  void end_chunk();
  std::string statistics() const;
  std::string summary(std::uint64_t start, std::string& offsets) const;

  std::filesystem::path path_;
  std::ofstream out_;
  std::uint64_t written_B_ = 0;
  std::uint32_t crc_ = 0;                                // of what was written so far
  std::vector<std::string> schemas_, channels_;          // their records
  std::map<std::string, std::uint16_t> schema_numbers_;  // from 1, by name
  std::vector<std::uint64_t> counts_;                    // messages by channel
  std::uint64_t start_ns_ = 0, end_ns_ = 0, messages_ = 0;

  std::string chunk_;  // records of the chunk under way
  std::uint64_t chunk_start_ns_ = 0, chunk_end_ns_ = 0, chunk_messages_ = 0;
  std::vector<std::vector<std::pair<std::uint64_t, std::uint64_t>>> chunk_index_;  // instant, place; by channel
  std::vector<ChunkIndex> chunks_;
  std::vector<MetadataIndex> metadata_;
};

}  // namespace trivela::evaluator::mcap
