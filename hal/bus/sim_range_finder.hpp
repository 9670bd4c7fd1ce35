#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "bus/domain/participant.hpp"
#include "bus/reader.hpp"
#include "hal/range_finder.hpp"
#include "idl/messages.hpp"

namespace trivela::hal {

/// The laser of the simulated world: sim/scan in. Scans that wait to be read are kept.
class SimRangeFinder final : public RangeFinder {
 public:
  /// Throws bus::Error if the bus refuses.
  SimRangeFinder(const bus::Participant& participant, std::uint8_t robot_id);
  SimRangeFinder(const SimRangeFinder&) = delete;
  SimRangeFinder& operator=(const SimRangeFinder&) = delete;

  /// True once the first scan has come, which says how the laser looks.
  bool connected(std::chrono::nanoseconds timeout) override;
  kicking::lob::ScannerIdentity identity() const override;
  kicking::lob::ScanGeometry geometry() const override { return geometry_; }
  std::optional<kicking::lob::Scan> read(std::chrono::nanoseconds timeout) override;
  LinkCounters counters() const override { return counters_; }
  std::string status() const override;
  bool up() const override { return counters_.scans > 0; }

 private:
  void take();

  std::uint8_t robot_id_;
  bus::Reader<msg::SimScan> reader_;
  kicking::lob::ScanGeometry geometry_;
  std::deque<kicking::lob::Scan> waiting_;
  std::uint64_t seq_ = 0;
  LinkCounters counters_;
};

}  // namespace trivela::hal
