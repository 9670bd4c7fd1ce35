#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "hal/range_finder.hpp"
#include "hal/scip/messages.hpp"
#include "hal/scip/reply.hpp"
#include "hal/scip/scan_clock.hpp"
#include "hal/scip/start_up.hpp"
#include "kicking/lob/scan.hpp"

namespace trivela::hal::scip {

/// From the replies to one MD, or to GDs, to scans. No clock, no line.
class ScanIntake {
 public:
  ScanIntake(Asking asking, const Parameters& parameters);

  const kicking::lob::ScanGeometry& geometry() const { return geometry_; }
  /// The MD or GD.
  const std::string& request() const { return request_; }

  /// The scan of a reply that arrived at arrival_ns. None: it holds none, and is counted where it should.
  std::optional<kicking::lob::Scan> take(const Reply& reply, std::int64_t arrival_ns, LinkCounters& counters);

  /// What the scanner said instead of the last scan; empty: nothing.
  const std::string& complaint() const { return complaint_; }

 private:
  Asking asking_;
  kicking::lob::ScanGeometry geometry_;
  std::string request_;
  ScanClock clock_;
  std::string complaint_;
};

}  // namespace trivela::hal::scip
