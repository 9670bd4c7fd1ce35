#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "hal/scip/messages.hpp"
#include "kicking/lob/scan.hpp"

namespace trivela::hal::scip {

/// The Parameters that geometry_of() turns into this geometry, with AMIN at first_step. Throws std::runtime_error
/// naming what SCIP cannot say.
Parameters parameters_for(const kicking::lob::ScanGeometry& geometry, int first_step, const std::string& model);

/// "KEY:value;" with its sum; "00P"; a complete reply.
std::string text_line(std::string_view key, std::string_view value);
std::string status_line(std::string_view status);
std::string plain_reply(std::string_view echo, std::string_view status, std::string_view lines = {});
/// With a time stamp and data in blocks of 64 bytes.
std::string scan_reply(std::string_view echo, std::string_view status, std::uint32_t stamp_ms, std::string_view data);

/// The scanner's side of SCIP 2.0: requests in, replies out. No clock, no line.
class EmulatedScanner {
 public:
  EmulatedScanner(kicking::lob::ScannerIdentity identity, Parameters parameters)
      : identity_(std::move(identity)), parameters_(std::move(parameters)) {}

  /// The answer to a request, without its line feed; nothing where a scan will be the answer.
  std::string answer(std::string_view request);

  /// A scan is wanted: an MD is under way, or a GD waits.
  bool measuring() const { return order_.has_value(); }
  /// The reply with the next scan; nothing where the MD leaves it out. Beams that `range_mm` does not have are errors.
  std::string next_scan(std::span<const std::uint32_t> range_mm, std::uint32_t stamp_ms);

  bool laser_on() const { return laser_on_; }
  /// True once after RS: the clock starts again.
  bool take_reset() { return std::exchange(reset_, false); }
  void stop();

 private:
  struct Order {
    std::string echo;  ///< MD: up to the number of scans
    std::string tail;  ///< of the echo: the request's text
    Section section;
    bool single = false;  ///< GD
    int skipped = 0;      ///< scans to leave out after each
    int to_skip = 0;
    int remaining = 0;  ///< 0: no end
  };

  std::string order(std::string_view request, std::string_view numbers, std::string_view tail);
  std::string parameters() const;
  std::string identity() const;
  std::string state() const;

  kicking::lob::ScannerIdentity identity_;
  Parameters parameters_;
  std::optional<Order> order_;
  bool laser_on_ = false;
  bool reset_ = false;
};

}  // namespace trivela::hal::scip
