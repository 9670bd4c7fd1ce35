#pragma once

#include <cstdint>
#include <map>

namespace trivela::nodes {

/// Finds what a stream lost from its sequence numbers, robot by robot, and keeps them unique when a node is started
/// anew.
class SequenceWatch {
 public:
  struct Finding {
    std::int64_t seq = 0;       ///< for the record: goes on rising when the writer starts again at 1
    std::int64_t gap = 0;       ///< numbers skipped right before this one
    bool out_of_order = false;  ///< not newer than its predecessor
  };

  /// `writer` tells the writers of a topic apart; a new one starts a new count, which is no gap.
  Finding see(std::uint8_t robot_id, std::uint64_t seq, std::uint64_t writer) {
    Stream& stream = streams_[robot_id];
    if (stream.writer != writer) {
      stream.offset += stream.last;
      stream.last = 0;
      stream.writer = writer;
      stream.fresh = true;
    }
    Finding finding{.seq = static_cast<std::int64_t>(stream.offset + seq)};
    if (seq <= stream.last) {
      finding.out_of_order = true;
      return finding;
    }
    if (!stream.fresh) finding.gap = static_cast<std::int64_t>(seq - stream.last - 1);
    stream.last = seq;
    stream.fresh = false;
    return finding;
  }

 private:
  struct Stream {
    std::uint64_t writer = 0;
    std::uint64_t offset = 0;
    std::uint64_t last = 0;
    bool fresh = true;
  };
  std::map<std::uint8_t, Stream> streams_;
};

}  // namespace trivela::nodes
