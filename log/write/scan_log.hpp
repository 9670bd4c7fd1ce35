#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kicking/lob/scan.hpp"
#include "log/write/writer.hpp"

namespace trivela::log {

/// What a scan record says about itself.
struct ScanSession {
  kicking::lob::ScannerIdentity identity;
  kicking::lob::ScanGeometry geometry;
  kicking::lob::LaserMount mount;
  std::int64_t started_t_ns = 0;
  std::int64_t realtime_offset_ns = 0;  ///< UTC since 1970 minus the record's clock
  bool simulated = false;
  std::string source;  ///< device address, "synthetic" with its seed, or the simulator's scenario
  std::string software_version;
};

/// From t_ns on kicks are of this set-point.
struct TestedSetPoint {
  std::int64_t t_ns = 0;
  std::optional<double> power{};  ///< none: of no set-point any more; 0 in the record
  std::int64_t kick_id = 0;       ///< 0: entered by hand
};

/// What a human said of the lob launched at launch_t_ns; the last word counts.
struct Verdict {
  std::int64_t launch_t_ns = 0;
  bool accepted = true;
  std::string why;
};

/// Records scans to a new SQLite file by the rules of the match log: WAL, synchronous FULL, group commits, no
/// overwriting, sound after a kill. Ranges are kept as the device gave them. Any thread; `finalise` once and last.
class ScanWriter {
 public:
  /// Throws std::runtime_error naming the path where it cannot be created or holds anything already.
  ScanWriter(const std::filesystem::path& path, const ScanSession& session, WriterOptions options = {});
  ~ScanWriter();
  ScanWriter(const ScanWriter&) = delete;
  ScanWriter& operator=(const ScanWriter&) = delete;

  /// Queues a scan. False: the queue is full, and the scan is counted as lost. Throws std::invalid_argument for another
  /// number of beams than the session's.
  bool push(const kicking::lob::Scan& scan);
  void set_point(const TestedSetPoint& tested);
  void verdict(const Verdict& verdict);

  /// Waits until everything pushed so far is committed. Throws std::runtime_error where the disk refuses.
  void flush();

  /// What the disk says at present; none: all is well. Scans that it refused are kept and tried again.
  std::optional<std::string> health() const;

  /// Ends the record and folds the write-ahead log into the one file. Throws std::runtime_error where scans could not
  /// be written; the earlier ones are kept.
  void finalise();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Reads a scan record and never changes it; one whose recorder was killed, or still runs, opens too. One thread at a
/// time.
class ScanReader {
 public:
  /// Throws std::runtime_error naming the path where it does not exist, is no scan record, or is damaged.
  explicit ScanReader(const std::filesystem::path& path);
  ~ScanReader();
  ScanReader(ScanReader&&) noexcept;

  const ScanSession& session() const;
  std::size_t size() const;

  /// Takes up what was recorded since; returns size().
  std::size_t refresh();

  /// Start of scan i, without reading its ranges.
  std::int64_t t_ns(std::size_t i) const;

  /// Throws std::runtime_error naming the path and the scan where its ranges are damaged.
  kicking::lob::Scan scan(std::size_t i) const;
  std::vector<TestedSetPoint> set_points() const;
  std::vector<Verdict> verdicts() const;
  /// Sentences: not closed, scans lost.
  std::vector<std::string> warnings() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// True: the file is a scan record (and not, say, a match log or a CSV).
bool is_scan_log(const std::filesystem::path& path);

/// Ranges as bytes: the difference of each beam to the one before (modulo 2^32; the first to 0), zigzag (0, -1, 1, -2,
/// ... become 0, 1, 2, 3, ...), as a variable-length integer of 7 bits a byte, low first, high bit set on all but the
/// last. A smooth scene takes 1 to 2 bytes a beam. Lossless for every value.
std::vector<std::uint8_t> encode_ranges(std::span<const std::uint32_t> range_mm);

/// None: the bytes end inside a number, or a number has more than 32 bits.
std::optional<std::vector<std::uint32_t>> decode_ranges(std::span<const std::uint8_t> bytes);

}  // namespace trivela::log
