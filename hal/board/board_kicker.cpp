#include "hal/board/board_kicker.hpp"

#include <fmt/core.h>
#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

namespace trivela::hal {

void ShotQueue::add(const Shot& shot) {
  shots_.insert(std::ranges::upper_bound(shots_, shot.t_ns, {}, &Shot::t_ns), shot);
}

void ShotQueue::withdraw(std::int64_t kick_id) {
  std::erase_if(shots_, [=](const Shot& shot) { return shot.kick_id == kick_id; });
}

std::optional<Shot> ShotQueue::take_due(std::int64_t now_ns) {
  if (next_ns() > now_ns || shots_.empty()) return std::nullopt;
  const Shot shot = shots_.front();
  shots_.erase(shots_.begin());
  return shot;
}

namespace {

constexpr std::int64_t kNsPerS = 1'000'000'000;
/// So long before a shot the line is left alone: whoever asks a terminal for its bytes may have to wait for a thread of
/// the kernel that has no real-time priority.
constexpr std::int64_t kQuiet_ns = 5'000'000;

std::int64_t steady_ns() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

int new_event() {
  const int event = ::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  if (event < 0) throw std::system_error{errno, std::generic_category(), "a kicker's thread cannot be woken"};
  return event;
}

}  // namespace

BoardKicker::BoardKicker(std::unique_ptr<KickerBoard> board)
    : board_(std::move(board)),
      capabilities_(board_->capabilities()),
      wake_(new_event()),
      status_(board_->status()),
      thread_([this] { run(); }) {}

BoardKicker::~BoardKicker() {
  make_safe();
  {
    const std::lock_guard lock{mutex_};
    stopping_ = true;
  }
  wake();
  thread_.join();
}

bool BoardKicker::connected(std::chrono::nanoseconds timeout) {
  std::unique_lock lock{mutex_};
  return changed_.wait_for(lock, timeout, [this] { return up_; });
}

std::optional<KickerSample> BoardKicker::read(std::chrono::nanoseconds timeout) {
  std::unique_lock lock{mutex_};
  changed_.wait_for(lock, timeout, [this] { return sample_.has_value(); });
  return std::exchange(sample_, std::nullopt);
}

void BoardKicker::fire(const Shot& shot) {
  {
    const std::lock_guard lock{mutex_};
    if (safe_) return;
    shots_.add(shot);
  }
  wake();
}

void BoardKicker::withdraw(std::int64_t kick_id) {
  const std::lock_guard lock{mutex_};
  shots_.withdraw(kick_id);
}

void BoardKicker::hold_when(const Hold& hold) {
  const std::lock_guard lock{mutex_};
  hold_ = hold;
}

void BoardKicker::call_when_written(const std::function<void()>& written) {
  const std::lock_guard lock{mutex_};
  written_ = written;
}

std::optional<ShotResult> BoardKicker::take_result() {
  const std::lock_guard lock{mutex_};
  if (results_.empty()) return std::nullopt;
  const ShotResult oldest = results_.front();
  results_.erase(results_.begin());
  return oldest;
}

/// The thread holds the mutex while it writes a shot: none leaves after this has returned.
void BoardKicker::make_safe() noexcept {
  const std::lock_guard lock{mutex_};
  safe_ = true;
  shots_.clear();
}

std::string BoardKicker::status() const {
  const std::lock_guard lock{mutex_};
  if (status_.empty() || dropped_.empty()) return status_ + dropped_;
  return status_ + "; " + dropped_;
}

void BoardKicker::run() {
  ::pthread_setname_np(::pthread_self(), "kicker board");
  ::prctl(PR_SET_TIMERSLACK, 1UL);  // ns; without a real-time priority it would wake up 50 us late
  while (fire_due()) {
    board_->lever(lever_kind_);
    if (next_shot_ns() - kQuiet_ns > steady_ns()) board_->step(steady_ns());
    publish();
    wait();
  }
}

std::int64_t BoardKicker::next_shot_ns() const {
  const std::lock_guard lock{mutex_};
  return shots_.next_ns();
}

/// False: the thread is to end.
bool BoardKicker::fire_due() {
  const std::lock_guard lock{mutex_};
  while (const auto shot = shots_.take_due(steady_ns())) send(*shot);
  return !stopping_;
}

/// The clock is looked at last: a stall before that drops the shot.
void BoardKicker::send(const Shot& shot) {
  using What = ShotResult::What;
  dropped_.clear();
  if (!board_->up()) return drop(shot, What::kDevice, "the board did not answer at its instant");
  if (hold_ && hold_(shot.judged_ns)) return drop(shot, What::kCalledOff, "it was called off before its instant");
  const std::int64_t now_ns = steady_ns();
  if (now_ns > shot.until_ns)
    return drop(shot, What::kLate,
                fmt::format("it was {:.3f} s too late", static_cast<double>(now_ns - shot.until_ns) / kNsPerS));
  if (!board_->stands_for(shot.kick_kind, now_ns))
    return drop(shot, What::kDevice, "the lever does not stand for its kind of kick");
  if (const std::string why = board_->shoot(shot.power, now_ns); !why.empty()) return drop(shot, What::kDevice, why);
  if (written_) written_();
  results_.push_back({shot.kick_id, What::kFired, steady_ns()});
}

void BoardKicker::drop(const Shot& shot, ShotResult::What what, const std::string& why) {
  dropped_ = fmt::format("kick {} was not fired: {}", shot.kick_id, why);
  results_.push_back({shot.kick_id, what, steady_ns()});
}

/// Hands out what the board has said.
void BoardKicker::publish() {
  const std::lock_guard lock{mutex_};
  if (const auto sample = board_->take_sample()) sample_ = sample;
  up_ = board_->up();
  status_ = board_->status();
  changed_.notify_all();
}

/// Until something comes, or is due.
void BoardKicker::wait() const {
  const std::int64_t shot_ns = next_shot_ns(), now_ns = steady_ns();
  const bool quiet = shot_ns - kQuiet_ns <= now_ns;
  const std::int64_t until_ns = quiet ? shot_ns : std::min(board_->next_ns(), shot_ns - kQuiet_ns);
  const std::int64_t left_ns = std::max<std::int64_t>(until_ns - now_ns, 0);
  const timespec time_out{static_cast<time_t>(left_ns / kNsPerS), left_ns % kNsPerS};
  std::array<pollfd, 2> polled{{{wake_.get(), POLLIN, 0}, {quiet ? -1 : board_->descriptor(), POLLIN, 0}}};
  ::ppoll(polled.data(), polled.size(), &time_out, nullptr);
  std::uint64_t pokes = 0;
  [[maybe_unused]] const auto got = ::read(wake_.get(), &pokes, sizeof pokes);
}

void BoardKicker::wake() const noexcept {
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(wake_.get(), &one, sizeof one);
}

}  // namespace trivela::hal
