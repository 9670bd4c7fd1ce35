#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "hal/range_finder.hpp"
#include "log/write/scan_log.hpp"
#include "nodes/runtime/node_context.hpp"
#include "nodes/runtime/simulated_device_notice.hpp"

namespace trivela::nodes {

/// Scans of a range finder to a scan record, with the set-point of every kick that was accepted. The record begins with
/// the first scan, when the scanner is known.
class ScanRecorderNode {
 public:
  ScanRecorderNode(NodeContext& context, std::unique_ptr<hal::RangeFinder> scanner);
  bus::Node& node() { return node_; }

  /// Ends the record, once the node has stopped. Throws std::runtime_error where scans could not be written.
  void finish();

  /// Scans recorded so far.
  std::uint64_t scans() const { return scans_; }
  /// Where they are: `scan_recorder.file`, in real time with a number behind its name where that is taken.
  const std::filesystem::path& file() const { return file_; }

 private:
  std::optional<kicking::lob::Scan> next_scan(std::chrono::nanoseconds timeout);
  void on_scan(const kicking::lob::Scan& scan);
  void on_receipt(const msg::KickReceipt& receipt);
  void open(std::int64_t t_ns);

  NodeContext& context_;
  std::unique_ptr<hal::RangeFinder> scanner_;
  bus::Node node_;
  SimulatedDeviceNotice emulation_;
  std::filesystem::path file_;
  std::optional<bus::Output<msg::StepDone>> step_done_;
  bool connected_ = false;
  bool waiting_ = false;  ///< said so
  bool up_ = false;
  std::mutex mutex_;  // of log_ and early_
  std::optional<log::ScanWriter> log_;
  std::vector<log::TestedSetPoint> early_;  // kicks before the first scan
  std::uint64_t scans_ = 0;
  std::uint64_t lost_ = 0;
};

}  // namespace trivela::nodes
