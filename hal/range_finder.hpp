#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "kicking/lob/scan.hpp"

namespace trivela::hal {

/// What went wrong on the line so far, and what came.
struct LinkCounters {
  std::uint64_t scans = 0;
  std::uint64_t torn_lines = 0;     ///< a reply that is not of the protocol
  std::uint64_t wrong_sums = 0;     ///< a checksum that does not fit
  std::uint64_t error_replies = 0;  ///< a status other than success
  std::uint64_t error_ranges = 0;   ///< beams with an error code (below kFirstRange_mm, 0 apart) in place of a range
  std::uint64_t lost_scans = 0;     ///< gaps between time stamps, and what a cut line cost
  std::uint64_t time_outs = 0;      ///< nothing came in time
  std::uint64_t reconnects = 0;     ///< the line was opened again
};

/// A scanning range finder. One thread at a time.
class RangeFinder {
 public:
  virtual ~RangeFinder() = default;

  /// The device is there and measures. Waits for it up to `timeout`, a second at most. False: not yet, status() says
  /// why.
  [[nodiscard]] virtual bool connected(std::chrono::nanoseconds timeout) = 0;

  /// Who it is and how it looks; meaningful once connected() was true.
  virtual kicking::lob::ScannerIdentity identity() const = 0;
  virtual kicking::lob::ScanGeometry geometry() const = 0;

  /// The next scan, in time order; waits for it up to `timeout`, a second at most. None: no scan yet, or the line is
  /// down (read() opens it again).
  virtual std::optional<kicking::lob::Scan> read(std::chrono::nanoseconds timeout) = 0;

  virtual LinkCounters counters() const = 0;

  /// One line on the state of the link, for a human: "measuring", "no device /dev/ttyACM0: ...".
  virtual std::string status() const = 0;

  /// The link is up and scans come.
  virtual bool up() const = 0;
};

}  // namespace trivela::hal
