#include <fmt/core.h>

#include <atomic>
#include <cmath>

#include "cli/launch/signals.hpp"
#include "cli/options/output.hpp"
#include "cli/scan/verb_parts.hpp"
#include "cli/verbs.hpp"
#include "emulators/scip/emulator.hpp"

namespace trivela::cli {
namespace {

/// The scans of a record or of the synthesis, one after the other, time divided by the speed.
class Playback {
 public:
  Playback(const EmulateFlags& flags, const SyntheticFlags& synthetic, const MountFlags& mount)
      : speed_(flags.speed), loop_(flags.loop) {
    if (flags.source == "synthetic") {
      SyntheticScans made = synthesize(synthetic, mount);
      session_ = made.session;
      scans_ = std::move(made.record.scans);
    } else {
      record_.emplace(flags.source);
      session_ = record_->session();
    }
    if (size() == 0) throw std::runtime_error{fmt::format("{} holds no scans", flags.source)};
  }

  const log::ScanSession& session() const { return session_; }

  std::optional<kicking::lob::Scan> next() {
    if (next_ == size()) {
      if (!loop_) return std::nullopt;
      next_ = 0;
      offset_ns_ = last_t_ns_ + std::llround(session_.geometry.scan_period_s * 1e9 / speed_);
    }
    kicking::lob::Scan scan = at(next_);
    if (next_ == 0) first_t_ns_ = scan.t_ns;
    ++next_;
    last_t_ns_ = offset_ns_ + std::llround(static_cast<double>(scan.t_ns - first_t_ns_) / speed_);
    scan.t_ns = last_t_ns_;
    return scan;
  }

 private:
  std::size_t size() const { return record_ ? record_->size() : scans_.size(); }
  kicking::lob::Scan at(std::size_t i) const { return record_ ? record_->scan(i) : scans_[i]; }

  double speed_;
  bool loop_;
  std::optional<log::ScanReader> record_;
  std::vector<kicking::lob::Scan> scans_;
  log::ScanSession session_;
  std::size_t next_ = 0;
  std::int64_t first_t_ns_ = 0;
  std::int64_t offset_ns_ = 0;
  std::int64_t last_t_ns_ = 0;
};

}  // namespace

int emulate_scanner(const EmulateFlags& flags, const SyntheticFlags& synthetic, const MountFlags& mount) {
  Playback playback(flags, synthetic, mount);
  SignalInbox signals;  // before the emulator's thread, which must not take them
  hal::scip::EmulatorConfig config;
  config.geometry = playback.session().geometry;
  if (flags.tcp_port) {
    config.port = hal::scip::EmulatedPort::kTcp;
    config.tcp_port = static_cast<std::uint16_t>(*flags.tcp_port);
  }
  std::atomic<bool> failed = false;
  const hal::scip::Emulator emulator(config, [&]() -> std::optional<kicking::lob::Scan> {
    try {
      return playback.next();
    } catch (const std::exception& error) {  // the emulator's thread has nobody else to tell
      warn(error.what());
      failed = true;
      return std::nullopt;
    }
  });
  if (playback.session().simulated) fmt::print(stderr, "{}\n", kSyntheticNotice);
  fmt::print("{}\n", emulator.address());
  std::fflush(stdout);
  while (!failed && !signals.stop_requested_within(200)) continue;
  return failed ? kFailed : kDone;
}

}  // namespace trivela::cli
