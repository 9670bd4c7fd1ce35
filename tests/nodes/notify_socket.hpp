#pragma once

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>

namespace trivela::nodes {

/// A service manager's end of the notification protocol: a Unix socket at a path, or at "@" and an abstract name.
class NotifySocket {
 public:
  explicit NotifySocket(const std::string& name) : socket_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, name.data(), name.size());
    if (name.front() == '@') address.sun_path[0] = '\0';
    const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
    if (::bind(socket_, reinterpret_cast<const sockaddr*>(&address), length) != 0)
      throw std::runtime_error{"cannot bind " + name};
  }
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;
  ~NotifySocket() { ::close(socket_); }

  /// The next word, waiting up to the timeout for it.
  std::optional<std::string> next(std::chrono::milliseconds timeout) {
    pollfd come{socket_, POLLIN, 0};
    if (::poll(&come, 1, static_cast<int>(timeout.count())) <= 0) return std::nullopt;
    char word[256];
    const ssize_t n = ::recv(socket_, word, sizeof word, 0);
    return n < 0 ? std::nullopt : std::optional<std::string>{std::in_place, word, static_cast<std::size_t>(n)};
  }

  /// How many words have come by now; they are taken.
  std::size_t drain() {
    std::size_t count = 0;
    while (next(std::chrono::milliseconds{0})) ++count;
    return count;
  }

 private:
  int socket_;
};

}  // namespace trivela::nodes
