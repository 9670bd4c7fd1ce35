#include "nodes/runtime/supervisor.hpp"

#include <fmt/core.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "config/text/parse_number.hpp"

namespace trivela::nodes {
namespace {

constexpr int kWordsInTheWatchdogsTime = 4;

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

/// Whom WATCHDOG_PID names alone has to say that it lives; where it names nobody, everybody has.
std::optional<std::chrono::microseconds> watchdog_of_environment() {
  const std::string whose = environment("WATCHDOG_PID");
  if (!whose.empty() && whose != std::to_string(getpid())) return std::nullopt;
  const auto longest_us = config::parse_number(environment("WATCHDOG_USEC"));
  if (!longest_us || !(*longest_us > 0.0 && *longest_us < 1e15)) return std::nullopt;
  return std::chrono::microseconds{static_cast<std::int64_t>(*longest_us)};
}

}  // namespace

Supervisor::Supervisor(const std::string& socket, std::optional<std::chrono::microseconds> watchdog)
    : socket_(socket), watchdog_(watchdog), descriptor_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
  const bool named = socket.size() > 1 && (socket.front() == '/' || socket.front() == '@');
  if (named && socket.size() < sizeof(sockaddr_un::sun_path) && descriptor_ >= 0) return;
  const int reason = errno;
  if (descriptor_ < 0) throw std::runtime_error{fmt::format("no Unix socket: {}", std::strerror(reason))};
  close(descriptor_);
  throw std::runtime_error{fmt::format("NOTIFY_SOCKET is {}: neither a path nor @ and a name", socket)};
}

Supervisor::~Supervisor() { close(descriptor_); }

std::shared_ptr<Supervisor> Supervisor::of_environment() {
  const std::string socket = environment("NOTIFY_SOCKET");
  return socket.empty() ? nullptr : std::make_shared<Supervisor>(socket, watchdog_of_environment());
}

void Supervisor::alive(Clock::time_point now) {
  if (!ready_) {
    ready_ = say("READY=1");
    said_ = now;
  } else if (watchdog_ && now - said_ >= *watchdog_ / kWordsInTheWatchdogsTime && say("WATCHDOG=1")) {
    said_ = now;
  }
}

bool Supervisor::say(const char* line) const {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, socket_.data(), socket_.size());
  if (socket_.front() == '@') address.sun_path[0] = '\0';
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + socket_.size());
  const auto length_said = static_cast<ssize_t>(std::strlen(line));
  return sendto(descriptor_, line, std::strlen(line), MSG_DONTWAIT | MSG_NOSIGNAL,
                reinterpret_cast<const sockaddr*>(&address), length) == length_said;
}

}  // namespace trivela::nodes
