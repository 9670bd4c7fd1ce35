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

BoardKicker::BoardKicker(std::unique_ptr<KickerBoard> board, std::chrono::nanoseconds latest)
    : board_(std::move(board)),
      latest_(latest),
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

void BoardKicker::fire(std::int64_t kick_id, double power, std::int64_t t_ns) {
  {
    const std::lock_guard lock{mutex_};
    if (safe_) return;
    shots_.add({kick_id, power, t_ns, steady_ns()});
  }
  wake();
}

void BoardKicker::withdraw(std::int64_t kick_id) {
  const std::lock_guard lock{mutex_};
  shots_.withdraw(kick_id, steady_ns());
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
  while (const auto shot = shots_.take_due(steady_ns())) {
    const std::string why = send(*shot, steady_ns());
    dropped_ = why.empty() ? why : fmt::format("kick {} was not fired: {}", shot->kick_id, why);
  }
  return !stopping_;
}

std::string BoardKicker::send(const Shot& shot, std::int64_t now_ns) {
  if (!board_->up()) return "the board did not answer at its instant";
  const std::int64_t late_ns = shot.late_ns(now_ns);
  if (late_ns > latest_.count())
    return fmt::format("it had waited {:.3f} s too long", static_cast<double>(late_ns) / kNsPerS);
  return board_->shoot(shot.power, now_ns);
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
