#include "emulators/scip/emulator.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "kicking/geometry/time.hpp"

namespace trivela::hal::scip {
namespace {

constexpr std::int64_t kLongestGap_ns = 1'000'000'000;  // within a recording
constexpr std::int64_t kNsPerMs = 1'000'000;

}  // namespace

EmulatedPlayback::EmulatedPlayback(const kicking::lob::ScanGeometry& geometry, std::uint32_t first_stamp_ms,
                                   ScanSource source, std::int64_t now_ns)
    : source_(std::move(source)),
      period_ns_(kicking::nanoseconds(geometry.scan_period_s)),
      measuring_takes_ns_(kicking::nanoseconds(static_cast<double>(geometry.beams) * geometry.beam_period_s)),
      switched_on_ns_(now_ns),
      first_stamp_ms_(first_stamp_ms),
      starts_ns_(now_ns) {}

void EmulatedPlayback::begin(std::int64_t now_ns) {
  starts_ns_ = std::max(starts_ns_, now_ns);
  if (!next_) advance();
}

std::uint32_t EmulatedPlayback::stamp_ms() const {
  return first_stamp_ms_ + static_cast<std::uint32_t>((starts_ns_ - switched_on_ns_) / kNsPerMs);
}

void EmulatedPlayback::advance() {
  if (ended_) return;
  auto following = source_();
  ended_ = !following;
  if (next_ && following) {
    const std::int64_t gap_ns = following->t_ns - next_->t_ns;
    starts_ns_ += gap_ns > 0 && gap_ns <= kLongestGap_ns ? gap_ns : period_ns_;
  }
  next_ = std::move(following);
}

void EmulatedPlayback::reset_clock(std::int64_t now_ns) {
  switched_on_ns_ = starts_ns_ = now_ns;
  first_stamp_ms_ = 0;
}

namespace {

constexpr std::size_t kLongestRequest = 64;
constexpr std::size_t kLongestQueue = 32768;  // bytes; scans measured meanwhile are lost

std::int64_t steady_ns() {
  return std::chrono::nanoseconds{std::chrono::steady_clock::now().time_since_epoch()}.count();
}

}  // namespace

EmulatedRangeFinder::EmulatedRangeFinder(const EmulatorConfig& config, ScanSource source)
    : port_(config.port),
      tcp_port_(config.tcp_port),
      scanner_(config.identity, parameters_for(config.geometry, config.first_step, config.identity.product)),
      playback_(config.geometry, config.first_stamp_ms, std::move(source), steady_ns()) {}

std::unique_ptr<EmulatedSocket> EmulatedRangeFinder::open_line() const {
  return port_ == EmulatedPort::kTcp ? emulated_tcp("SCIP", tcp_port_) : emulated_terminal("SCIP", "scanner");
}

std::vector<std::string> EmulatedRangeFinder::take(std::string_view bytes, std::int64_t now_ns) {
  std::vector<std::string> said;
  for (const char byte : bytes) {
    if (byte != '\n' && byte != '\r') {
      if (request_.size() < kLongestRequest) request_ += byte;
      continue;
    }
    if (request_.empty()) continue;
    std::string answer = scanner_.answer(std::exchange(request_, {}));
    if (!answer.empty()) said.push_back(std::move(answer));
    if (scanner_.take_reset()) playback_.reset_clock(now_ns);
  }
  note_measuring(now_ns);
  return said;
}

std::int64_t EmulatedRangeFinder::next_ns() const {
  return scanner_.measuring() && playback_.has_next() ? playback_.complete_ns() : kNever_ns;
}

std::vector<std::string> EmulatedRangeFinder::tick(std::int64_t now_ns) {
  if (unread_B > kLongestQueue) {
    playback_.postpone();
    return {};
  }
  std::string scan = scanner_.next_scan(playback_.range_mm(), playback_.stamp_ms());
  playback_.advance();
  note_measuring(now_ns);
  if (scan.empty()) return {};
  return {std::move(scan)};
}

void EmulatedRangeFinder::hang_up() {
  scanner_.stop();
  request_.clear();
  was_measuring_ = false;
}

void EmulatedRangeFinder::note_measuring(std::int64_t now_ns) {
  if (scanner_.measuring() && !was_measuring_) playback_.begin(now_ns);
  was_measuring_ = scanner_.measuring();
}

}  // namespace trivela::hal::scip
