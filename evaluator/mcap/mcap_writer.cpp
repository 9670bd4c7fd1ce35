#include "evaluator/mcap/mcap_writer.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace trivela::evaluator::mcap {
namespace {

constexpr std::size_t kChunk_B = 1 << 20;
constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};

enum Opcode : char {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F
};

std::uint32_t crc_after(std::uint32_t crc, std::string_view bytes) {
  return static_cast<std::uint32_t>(crc32_z(crc, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

/// Content of a record, member by member, little endian and without gaps.
class Content {
 public:
  template <class Number>
  Content& put(Number number) {
    append(bytes_, number);
    return *this;
  }
  Content& put_text(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size()));
    bytes_.append(text);
    return *this;
  }
  /// An array or map: its size in bytes, then its members.
  Content& put_array(const Content& members) { return put_text(members.bytes_); }

  std::string as_record(Opcode opcode) const {
    std::string record(1, opcode);
    append(record, std::uint64_t{bytes_.size()});
    return record += bytes_;
  }

 private:
  std::string bytes_;
};

}  // namespace

Writer::Writer(std::filesystem::path path, const std::string& library) : path_(std::move(path)) {
  errno = 0;
  out_.open(path_, std::ios::binary);
  chunk_.reserve(kChunk_B + kChunk_B / 8);
  pour(kMagic);
  pour(Content{}.put_text("").put_text(library).as_record(kHeader));
}

void Writer::pour(std::string_view bytes) {
  if (!out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size())))
    throw std::runtime_error(fmt::format("cannot write {}: {}", path_.string(), std::strerror(errno)));
  written_B_ += bytes.size();
  crc_ = crc_after(crc_, bytes);
}

std::uint16_t Writer::add_channel(const std::string& topic, const Schema& schema) {
  constexpr std::size_t kMost = 65'535;
  if (channels_.size() >= kMost)
    throw std::runtime_error(fmt::format("{} would have more than {} topics", path_.string(), kMost));
  const auto [known, is_new] =
      schema_numbers_.try_emplace(schema.name, static_cast<std::uint16_t>(schemas_.size() + 1));
  if (is_new) {
    schemas_.push_back(Content{}
                           .put(known->second)
                           .put_text(schema.name)
                           .put_text("ros2msg")
                           .put_text(schema.text)
                           .as_record(kSchema));
    chunk_ += schemas_.back();
  }
  const auto channel = static_cast<std::uint16_t>(channels_.size());
  channels_.push_back(
      Content{}.put(channel).put(known->second).put_text(topic).put_text("cdr").put_array({}).as_record(kChannel));
  chunk_ += channels_.back();
  counts_.push_back(0);
  chunk_index_.emplace_back();
  return channel;
}

void Writer::write(std::uint16_t channel, std::uint32_t sequence, std::uint64_t t_ns, std::string_view message) {
  chunk_index_.at(channel).emplace_back(t_ns, chunk_.size());
  chunk_.push_back(static_cast<char>(kMessage));  // by hand: it is done once a row
  append(chunk_, std::uint64_t{sizeof(channel) + sizeof(sequence) + 2 * sizeof(t_ns) + message.size()});
  append(chunk_, channel);
  append(chunk_, sequence);
  append(chunk_, t_ns);  // logged
  append(chunk_, t_ns);  // published
  chunk_ += message;
  chunk_start_ns_ = chunk_messages_ == 0 ? t_ns : std::min(chunk_start_ns_, t_ns);
  chunk_end_ns_ = chunk_messages_ == 0 ? t_ns : std::max(chunk_end_ns_, t_ns);
  start_ns_ = messages_ == 0 ? t_ns : std::min(start_ns_, t_ns);
  end_ns_ = messages_ == 0 ? t_ns : std::max(end_ns_, t_ns);
  ++chunk_messages_;
  ++messages_;
  ++counts_[channel];
  if (chunk_.size() >= kChunk_B) end_chunk();
}

void Writer::end_chunk() {
  if (chunk_.empty()) return;
  const std::uint64_t offset = written_B_;
  const std::uint64_t record_bytes = chunk_.size();
  Content head;
  head.put(chunk_start_ns_)
      .put(chunk_end_ns_)
      .put(record_bytes)
      .put(crc_after(0, chunk_))
      .put_text("")
      .put(record_bytes);
  std::string record = head.as_record(kChunk);
  const std::uint64_t length = record.size() - 9 + record_bytes;
  std::memcpy(record.data() + 1, &length, sizeof(length));
  pour(record);
  pour(chunk_);
  ChunkIndex index{chunk_start_ns_, chunk_end_ns_, offset, written_B_ - offset, record_bytes, {}, 0};
  const std::uint64_t indexes_at = written_B_;
  for (std::size_t i = 0; i < chunk_index_.size(); ++i) {
    auto& entries = chunk_index_[i];
    if (entries.empty()) continue;
    std::ranges::stable_sort(entries, {}, &std::pair<std::uint64_t, std::uint64_t>::first);
    Content places;
    for (const auto& [t_ns, place] : entries) places.put(t_ns).put(place);
    const auto channel = static_cast<std::uint16_t>(i);
    index.indexes[channel] = written_B_;
    pour(Content{}.put(channel).put_array(places).as_record(kMessageIndex));
    entries.clear();
  }
  index.indexes_B = written_B_ - indexes_at;
  chunks_.push_back(std::move(index));
  chunk_.clear();
  chunk_messages_ = 0;
}

void Writer::add_metadata(const std::string& name, const Facts& facts) {
  Content map;
  for (const auto& [key, value] : facts) map.put_text(key).put_text(value);
  const std::string record = Content{}.put_text(name).put_array(map).as_record(kMetadata);
  metadata_.push_back({written_B_, record.size(), name});
  pour(record);
}

std::string Writer::statistics() const {
  Content counts;
  for (std::size_t i = 0; i < counts_.size(); ++i) counts.put(static_cast<std::uint16_t>(i)).put(counts_[i]);
  return Content{}
      .put(messages_)
      .put(static_cast<std::uint16_t>(schemas_.size()))
      .put(static_cast<std::uint32_t>(channels_.size()))
      .put(std::uint32_t{0})  // attachments
      .put(static_cast<std::uint32_t>(metadata_.size()))
      .put(static_cast<std::uint32_t>(chunks_.size()))
      .put(start_ns_)
      .put(end_ns_)
      .put_array(counts)
      .as_record(kStatistics);
}

/// The records of the summary, which begins at `start`, and in `offsets` where each kind lies.
std::string Writer::summary(std::uint64_t start, std::string& offsets) const {
  std::vector<std::string> chunks, metadata;
  for (const ChunkIndex& c : chunks_) {
    Content indexes;
    for (const auto& [channel, offset] : c.indexes) indexes.put(channel).put(offset);
    chunks.push_back(Content{}
                         .put(c.start_ns)
                         .put(c.end_ns)
                         .put(c.offset)
                         .put(c.length)
                         .put_array(indexes)
                         .put(c.indexes_B)
                         .put_text("")
                         .put(c.records_B)
                         .put(c.records_B)
                         .as_record(kChunkIndex));
  }
  for (const MetadataIndex& m : metadata_)
    metadata.push_back(Content{}.put(m.offset).put(m.length).put_text(m.name).as_record(kMetadataIndex));
  std::string all;
  const auto group = [&](Opcode opcode, const std::vector<std::string>& records) {
    if (records.empty()) return;
    const std::uint64_t at = start + all.size();
    for (const std::string& record : records) all += record;
    offsets +=
        Content{}.put(static_cast<std::uint8_t>(opcode)).put(at).put(start + all.size() - at).as_record(kSummaryOffset);
  };
  group(kSchema, schemas_);
  group(kChannel, channels_);
  group(kStatistics, {statistics()});
  group(kChunkIndex, chunks);
  group(kMetadataIndex, metadata);
  return all;
}

void Writer::close() {
  end_chunk();
  pour(Content{}.put(crc_).as_record(kDataEnd));
  const std::uint64_t start = written_B_;
  std::string offsets;
  std::string end = summary(start, offsets);
  const std::uint64_t offsets_at = start + end.size();
  end += offsets;
  const std::string footer = Content{}.put(start).put(offsets_at).put(std::uint32_t{0}).as_record(kFooter);
  end += footer.substr(0, footer.size() - sizeof(std::uint32_t));  // the CRC covers the footer up to itself
  const std::uint32_t crc = crc_after(0, end);
  end.append(reinterpret_cast<const char*>(&crc), sizeof(crc));
  pour(end);
  pour(kMagic);
  errno = 0;
  out_.close();
  if (!out_) throw std::runtime_error(fmt::format("cannot write {}: {}", path_.string(), std::strerror(errno)));
}

}  // namespace trivela::evaluator::mcap
