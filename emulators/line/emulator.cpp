#include "emulators/line/emulator.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <stdexcept>

namespace trivela::hal {
namespace {

constexpr std::int64_t kLongestWait_ns = 999'999'999;
constexpr std::size_t kMostWaiting = 256;  // messages

std::int64_t emulated_now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace

EmulatedLine::EmulatedLine(std::unique_ptr<EmulatedSocket> socket, EmulatedDevice& device)
    : socket_(std::move(socket)), device_(device), wake_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (!wake_) throw std::runtime_error{"an emulator cannot be woken: " + system_error(errno)};
  thread_ = std::thread{[this] { run(); }};
}

EmulatedLine::~EmulatedLine() {
  {
    const std::lock_guard lock{mutex_};
    stopping_ = true;
  }
  wake();
  thread_.join();
}

void EmulatedLine::pull() {
  std::unique_lock lock{mutex_};
  cable_wanted_ = false;
  wake();
  changed_.wait(lock, [this] { return !cable_; });
}

void EmulatedLine::plug() {
  std::unique_lock lock{mutex_};
  cable_wanted_ = true;
  wake();
  changed_.wait(lock, [this] { return cable_ || cable_error_; });
  if (auto error = std::exchange(cable_error_, nullptr)) std::rethrow_exception(error);
}

void EmulatedLine::hold(bool held) {
  const std::lock_guard lock{mutex_};
  held_ = held;
  wake();
}

void EmulatedLine::with_device(const std::function<void()>& look) {
  const std::lock_guard lock{mutex_};
  look();
  wake();
}

bool EmulatedLine::wait(std::chrono::nanoseconds timeout, const std::function<bool()>& done) {
  std::unique_lock lock{mutex_};
  return changed_.wait_for(lock, timeout, done);
}

void EmulatedLine::run() {
  std::unique_lock lock{mutex_};
  while (!stopping_) {
    if (cable_wanted_ != cable_) change_cable();
    receive();
    const std::int64_t now_ns = emulated_now_ns();
    if (device_.next_ns() <= now_ns) say(device_.tick(now_ns));  // also while nobody can hear it
    send();
    changed_.notify_all();
    wait_for_events(lock);
  }
}

void EmulatedLine::change_cable() {
  client_gone();
  try {
    cable_wanted_ ? socket_->plug() : socket_->pull();
    cable_ = cable_wanted_;
  } catch (const std::exception&) {
    cable_error_ = std::current_exception();
    cable_wanted_ = cable_;
  }
}

void EmulatedLine::receive() {
  std::array<char, 256> bytes;
  while (cable_ && !held_ && socket_->client() >= 0) {
    const ssize_t count = ::read(socket_->client(), bytes.data(), bytes.size());
    const std::int64_t now_ns = emulated_now_ns();
    if (count > 0) {
      say(device_.take({bytes.data(), static_cast<std::size_t>(count)}, now_ns));
    } else if (count == 0 || (errno != EAGAIN && errno != EINTR)) {
      client_gone();
      socket_->hang_up();
      return;
    } else {
      return;
    }
  }
}

/// What nobody reads for long is not kept: a device does not wait either.
void EmulatedLine::say(std::vector<std::string> messages) {
  if (out_.size() >= kMostWaiting) return;
  for (std::string& message : messages) {
    device_.unread_B += message.size();
    out_.push_back(std::move(message));
  }
}

void EmulatedLine::send() {
  if (!cable_ || socket_->client() < 0) return forget_unread();
  while (!out_.empty()) {
    std::string& message = out_.front();
    ssize_t count = ::send(socket_->client(), message.data(), message.size(), MSG_NOSIGNAL);
    if (count < 0 && errno == ENOTSOCK) count = ::write(socket_->client(), message.data(), message.size());
    if (count < 0) return;  // the next read says whether the client is gone
    message.erase(0, static_cast<std::size_t>(count));
    device_.unread_B -= static_cast<std::size_t>(count);
    if (message.empty()) out_.pop_front();
  }
}

void EmulatedLine::wait_for_events(std::unique_lock<std::mutex>& lock) {
  const auto events = static_cast<short>((held_ ? 0 : POLLIN) | (out_.empty() ? 0 : POLLOUT));
  std::array<pollfd, 3> polled{{{wake_.get(), POLLIN, 0},
                                {cable_ ? socket_->listener() : -1, POLLIN, 0},
                                {cable_ ? socket_->client() : -1, events, 0}}};
  const std::int64_t left_ns = device_.next_ns() - emulated_now_ns();
  const timespec time_out{0, std::clamp<std::int64_t>(left_ns, 0, kLongestWait_ns)};
  lock.unlock();
  ::ppoll(polled.data(), polled.size(), &time_out, nullptr);
  std::uint64_t pokes = 0;
  [[maybe_unused]] const auto got = ::read(wake_.get(), &pokes, sizeof pokes);
  lock.lock();
  if (cable_ && (polled[1].revents & POLLIN) != 0) socket_->accept();
}

void EmulatedLine::forget_unread() {
  out_.clear();
  device_.unread_B = 0;
}

void EmulatedLine::client_gone() {
  forget_unread();
  device_.hang_up();
}

void EmulatedLine::wake() const {
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(wake_.get(), &one, sizeof one);
}

}  // namespace trivela::hal
