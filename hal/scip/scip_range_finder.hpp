#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "hal/line/line.hpp"
#include "hal/range_finder.hpp"
#include "hal/scip/reply.hpp"
#include "hal/scip/scan_intake.hpp"
#include "hal/scip/start_up.hpp"

namespace trivela::hal::scip {

/// A Hokuyo scanner that speaks SCIP 2.0. The line is opened, and opened again whenever it drops or brings no scan for
/// kSilence, by connected() and read(), between pauses. A damaged reply costs its scan and is counted; the gap that it
/// leaves between the time stamps is a lost scan too. Ranges are the scanner's, error codes below kFirstRange_mm among
/// them. t_ns is of the steady clock: ScanClock's, from the scanner's millisecond. Whether a model stamps the first
/// beam or the index mark a fraction of a revolution before it is not in the protocol's specification; the first is
/// assumed.
class ScipRangeFinder final : public RangeFinder {
 public:
  static constexpr std::chrono::nanoseconds kSilence = std::chrono::milliseconds(500);

  explicit ScipRangeFinder(std::unique_ptr<Line> line, Asking asking = Asking::kContinuous);
  /// Tells the scanner to stop and waits a moment for its answer.
  ~ScipRangeFinder() override;
  ScipRangeFinder(const ScipRangeFinder&) = delete;
  ScipRangeFinder& operator=(const ScipRangeFinder&) = delete;

  bool connected(std::chrono::nanoseconds timeout) override;
  kicking::lob::ScannerIdentity identity() const override { return identity_; }
  kicking::lob::ScanGeometry geometry() const override { return geometry_; }
  std::optional<kicking::lob::Scan> read(std::chrono::nanoseconds timeout) override;
  LinkCounters counters() const override { return counters_; }
  std::string status() const override { return status_; }
  bool up() const override { return phase_ == Phase::kMeasuring && scan_came_; }

 private:
  using Clock = std::chrono::steady_clock;
  enum class Phase { kClosed, kOpening, kStarting, kMeasuring };

  /// The line is open, and an answer or a scan is due by phase_ends_.
  bool talking() const { return phase_ == Phase::kStarting || phase_ == Phase::kMeasuring; }
  Clock::time_point enter(std::chrono::nanoseconds timeout);
  /// Brings the link one step further, waiting for the device until `deadline` at the latest.
  void step(Clock::time_point deadline);
  void open(Clock::time_point deadline);
  void receive(Clock::time_point deadline);
  void take_damage(bool count);
  void take(const Reply& reply, Clock::time_point arrival);
  void follow(StartUp::Progress progress);
  void start_measuring();
  void take_scan(const Reply& reply, Clock::time_point arrival);
  void time_out();
  void ask(const std::string& request);
  void send(const std::string& request);
  void drop(const std::string& why);

  std::unique_ptr<Line> line_;
  Asking asking_;
  Phase phase_ = Phase::kClosed;
  Clock::time_point phase_ends_{};  // closed: the pause; else: something must have come
  bool forgave_ = false;            // the end of the phase, since the last thing that came
  bool opened_ = false;             // once before
  bool in_step_ = false;            // a request was answered since it was opened
  bool scan_came_ = false;          // since it was opened
  bool asked_ = false;              // for the next scan, one by one
  std::optional<StartUp> start_up_;
  ReplyParser parser_;
  std::optional<ScanIntake> intake_;
  bool known_ = false;  // identity_ and geometry_
  kicking::lob::ScannerIdentity identity_;
  kicking::lob::ScanGeometry geometry_;
  std::deque<kicking::lob::Scan> scans_;  // read, not yet taken
  std::int64_t last_t_ns_ = 0;
  LinkCounters counters_;
  std::string status_;
};

}  // namespace trivela::hal::scip
