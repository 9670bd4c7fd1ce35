#include "hal/scip/scip_range_finder.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <thread>
#include <utility>

#include "kicking/geometry/time.hpp"

namespace trivela::hal::scip {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr nanoseconds kLongestCall = milliseconds(850);  // and kWriting
constexpr nanoseconds kPause = milliseconds(200);
constexpr nanoseconds kLongestOpening = std::chrono::seconds(1);
constexpr nanoseconds kAnswer = milliseconds(400);
constexpr nanoseconds kFirstScan = std::chrono::seconds(3);  // a motor may have to come up to speed
constexpr nanoseconds kForgiven = milliseconds(200);
constexpr nanoseconds kWriting = milliseconds(100);
constexpr nanoseconds kGoodbye = milliseconds(200);

std::int64_t ns_of(std::chrono::steady_clock::time_point t) {
  return std::chrono::duration_cast<nanoseconds>(t.time_since_epoch()).count();
}

bool same(const kicking::lob::ScanGeometry& a, const kicking::lob::ScanGeometry& b) {
  return a.beams == b.beams && a.first_angle_rad == b.first_angle_rad && a.step_rad == b.step_rad &&
         a.scan_period_s == b.scan_period_s;
}

bool success(const Reply& reply) {
  return reply.status == "00" || reply.status == "99" || (reply.echo == kBM && reply.status == "02") ||
         reply.echo == kScip20;
}

}  // namespace

ScipRangeFinder::ScipRangeFinder(std::unique_ptr<Line> line, Asking asking)
    : line_(std::move(line)), asking_(asking), status_("opening " + line_->name()) {}

ScipRangeFinder::~ScipRangeFinder() {
  if (!talking()) return;
  const auto deadline = Clock::now() + kGoodbye;
  if (!line_->write(std::string{kQT} + "\n", deadline)) return;
  // A socket closed with scans unread would take the request back.
  std::array<char, 4096> bytes{};
  while (Clock::now() < deadline) {
    const auto count = line_->read(bytes, deadline);
    if (!count) return;
    for (const Reply& reply : parser_.feed({bytes.data(), *count})) {
      if (reply.echo == kQT) return;
    }
  }
}

bool ScipRangeFinder::connected(nanoseconds timeout) {
  const auto deadline = enter(timeout);
  while (!up()) {
    step(deadline);
    if (Clock::now() >= deadline) break;
  }
  return up();
}

std::optional<kicking::lob::Scan> ScipRangeFinder::read(nanoseconds timeout) {
  const auto deadline = enter(timeout);
  while (scans_.empty()) {
    step(deadline);
    if (scans_.empty() && Clock::now() >= deadline) return std::nullopt;
  }
  auto scan = std::move(scans_.front());
  scans_.pop_front();
  return scan;
}

ScipRangeFinder::Clock::time_point ScipRangeFinder::enter(nanoseconds timeout) {
  const auto now = Clock::now();
  // What came while nobody read is still to be read: once, it gets a chance.
  if (talking() && now >= phase_ends_ && !std::exchange(forgave_, true)) phase_ends_ = now + kForgiven;
  return now + std::clamp(timeout, nanoseconds::zero(), kLongestCall);
}

void ScipRangeFinder::step(Clock::time_point deadline) {
  const auto until = std::min(deadline, phase_ends_);
  switch (phase_) {
    case Phase::kClosed:
      std::this_thread::sleep_until(until);
      if (Clock::now() < phase_ends_) return;
      phase_ = Phase::kOpening;
      phase_ends_ = Clock::now() + kLongestOpening;
      return;
    case Phase::kOpening:
      return open(until);
    case Phase::kMeasuring:
      if (asking_ == Asking::kOneByOne && !std::exchange(asked_, true)) send(intake_->request());
      return receive(until);
    default:
      return receive(until);
  }
}

void ScipRangeFinder::open(Clock::time_point deadline) {
  const Line::Opening opening = line_->open(deadline);
  if (opening == Line::Opening::kOpen) {
    if (std::exchange(opened_, true)) ++counters_.reconnects;
    phase_ = Phase::kStarting;
    scan_came_ = false;
    in_step_ = false;
    parser_ = {};
    start_up_.emplace(asking_);
    ask(start_up_->request());
  } else if (opening == Line::Opening::kFailed || Clock::now() >= phase_ends_) {
    drop(fmt::format("no device {}: {}", line_->name(), line_->why()));
  }
}

void ScipRangeFinder::receive(Clock::time_point deadline) {
  std::array<char, 4096> bytes;
  if (phase_ == Phase::kClosed) return;
  const auto count = line_->read(bytes, deadline);
  const auto arrival = Clock::now();
  if (!count) return drop(fmt::format("{}: the line is cut: {}", line_->name(), line_->why()));
  const bool was_in_step = in_step_;
  for (const Reply& reply : parser_.feed({bytes.data(), *count})) take(reply, arrival);
  take_damage(was_in_step);
  if (talking() && Clock::now() >= phase_ends_) time_out();
}

void ScipRangeFinder::take_damage(bool count) {
  const Damages damages = parser_.take_damages();
  // Before its first answer, the rest of what an earlier host asked for passes by.
  if (!count || damages.torn + damages.wrong_sums == 0) return;
  counters_.torn_lines += damages.torn;
  counters_.wrong_sums += damages.wrong_sums;
  asked_ = false;
}

void ScipRangeFinder::take(const Reply& reply, Clock::time_point arrival) {
  if (phase_ == Phase::kStarting) {
    const auto progress = start_up_->take(reply);
    if (progress == StartUp::Progress::kWaiting) return;
    in_step_ = true;
    if (!success(reply)) ++counters_.error_replies;
    follow(progress);
  } else if (phase_ == Phase::kMeasuring) {
    take_scan(reply, arrival);
  }
}

void ScipRangeFinder::follow(StartUp::Progress progress) {
  if (progress == StartUp::Progress::kNext) ask(start_up_->request());
  if (progress == StartUp::Progress::kFailed) drop(fmt::format("{}: {}", line_->name(), start_up_->why()));
  if (progress == StartUp::Progress::kDone) start_measuring();
}

void ScipRangeFinder::start_measuring() {
  intake_.emplace(asking_, start_up_->parameters());
  if (known_ && !same(intake_->geometry(), geometry_)) {
    return drop(fmt::format("{}: another scanner is there, {} with {} beams", line_->name(),
                            start_up_->identity().product, intake_->geometry().beams));
  }
  known_ = true;
  identity_ = start_up_->identity();
  geometry_ = intake_->geometry();
  asked_ = false;
  phase_ = Phase::kMeasuring;
  phase_ends_ = Clock::now() + kFirstScan;
}

void ScipRangeFinder::take_scan(const Reply& reply, Clock::time_point arrival) {
  asked_ = false;
  auto scan = intake_->take(reply, ns_of(arrival), counters_);
  if (!scan) {
    if (!intake_->complaint().empty()) status_ = fmt::format("{}: {}", line_->name(), intake_->complaint());
    return;
  }
  if (!scan_came_ && last_t_ns_ > 0) {
    const double gap_s = kicking::seconds(scan->t_ns - last_t_ns_);
    counters_.lost_scans += static_cast<std::uint64_t>(std::max(0L, std::lround(gap_s / geometry_.scan_period_s) - 1));
  }
  last_t_ns_ = scan->t_ns = std::max(scan->t_ns, last_t_ns_ + 1);
  scans_.push_back(*std::move(scan));
  scan_came_ = true;
  forgave_ = false;
  phase_ends_ = arrival + kSilence;
  status_ = "measuring";
}

void ScipRangeFinder::time_out() {
  ++counters_.time_outs;
  if (phase_ == Phase::kMeasuring) {
    const std::chrono::duration<double> silence = scan_came_ ? kSilence : kFirstScan;
    const std::string& complaint = intake_->complaint();
    return drop(fmt::format("{}: no scan for {:.1f} s{}{}", line_->name(), silence.count(),
                            complaint.empty() ? "" : ", and before: ", complaint));
  }
  status_ = fmt::format("{}: no answer to {}", line_->name(), start_up_->request());
  follow(start_up_->timed_out());
}

void ScipRangeFinder::ask(const std::string& request) {
  phase_ends_ = Clock::now() + kAnswer;
  forgave_ = false;
  send(request);
}

void ScipRangeFinder::send(const std::string& request) {
  if (!line_->write(request + "\n", Clock::now() + kWriting)) {
    drop(fmt::format("{}: the line is cut: {}", line_->name(), line_->why()));
  }
}

void ScipRangeFinder::drop(const std::string& why) {
  line_->close();
  phase_ = Phase::kClosed;
  phase_ends_ = Clock::now() + kPause;
  status_ = why;
}

}  // namespace trivela::hal::scip
