#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace trivela::log {

enum class LossKind {
  kLost,        ///< the bus reported lost samples
  kGaps,        ///< sequence numbers that never arrived
  kOverflow,    ///< the log's queue was full
  kNanRefused,  ///< NaN, infinity or NULL where a number must be
  kRejected,    ///< against the schema: unknown label, wrong type, same key twice
  kOutOfOrder   ///< older than its predecessor; nothing is missing
};

/// Counters of one stream; row of table `losses`.
struct Loss {
  std::string stream;  ///< name of the table that the samples were for
  std::int64_t received = 0;
  std::int64_t lost = 0;
  std::int64_t gaps = 0;
  std::int64_t overflow = 0;
  std::int64_t nan_refused = 0;
  std::int64_t rejected = 0;
  std::int64_t out_of_order = 0;

  /// Samples that are not in the log. What the bus reports as lost shows as a gap too, so the larger of the two counts.
  std::int64_t missing() const { return (lost > gaps ? lost : gaps) + overflow + nan_refused + rejected; }
};

/// A stream of one robot that said nothing for too long; row of table `losses` with counters of 0.
struct Silence {
  std::string stream;  ///< name of the table that the samples are for
  int robot_id = 0;
  std::int64_t from_t_ns = 0;             ///< last sample before it
  std::optional<std::int64_t> to_t_ns{};  ///< first sample after it; none: it lasts
};

}  // namespace trivela::log
