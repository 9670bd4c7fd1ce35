#include "hal/line/descriptor.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <system_error>
#include <utility>

namespace trivela::hal {
namespace {

using std::chrono::nanoseconds;
using std::chrono::steady_clock;

constexpr long kNsPerSecond = 1'000'000'000;

bool try_again(int error) { return error == EAGAIN || error == EWOULDBLOCK || error == EINTR; }

}  // namespace

std::string system_error(int error) {
  std::string text = std::generic_category().message(error);
  if (text.size() > 1 && std::islower(static_cast<unsigned char>(text[1])) != 0) {
    text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  }
  return text;
}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  if (this != &other) reset(other.release());
  return *this;
}

void Descriptor::reset(int fd) noexcept {
  if (fd_ >= 0) ::close(fd_);
  fd_ = fd;
}

int Descriptor::release() noexcept { return std::exchange(fd_, -1); }

short Descriptor::wait(short events, Line::Deadline deadline) const {
  for (;;) {
    const nanoseconds left = std::max<nanoseconds>(deadline - steady_clock::now(), nanoseconds::zero());
    const timespec time_out{static_cast<time_t>(left.count() / kNsPerSecond), left.count() % kNsPerSecond};
    pollfd polled{fd_, events, 0};
    const int ready = ::ppoll(&polled, 1, &time_out, nullptr);
    if (ready > 0) return polled.revents;
    if (ready == 0 || errno != EINTR) return 0;
  }
}

std::optional<std::size_t> Descriptor::read(std::span<char> bytes, Line::Deadline deadline, std::string& why) const {
  do {
    if (wait(POLLIN, deadline) == 0) return 0;
    const ssize_t count = ::read(fd_, bytes.data(), bytes.size());
    if (count > 0) return static_cast<std::size_t>(count);
    if (count == 0) {
      why = "the other side hung up";
      return std::nullopt;
    }
    if (!try_again(errno)) {
      why = system_error(errno);
      return std::nullopt;
    }
  } while (steady_clock::now() < deadline);
  return 0;
}

bool Descriptor::write(std::string_view bytes, Line::Deadline deadline, std::string& why) const {
  while (!bytes.empty()) {
    // A terminal has no send(), and a write() to it raises no SIGPIPE.
    ssize_t count = ::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count < 0 && errno == ENOTSOCK) count = ::write(fd_, bytes.data(), bytes.size());
    if (count > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(count));
      continue;
    }
    if (count < 0 && !try_again(errno)) {
      why = system_error(errno);
      return false;
    }
    if (wait(POLLOUT, deadline) == 0 || steady_clock::now() >= deadline) {
      why = "it takes no bytes";
      return false;
    }
  }
  return true;
}

}  // namespace trivela::hal
