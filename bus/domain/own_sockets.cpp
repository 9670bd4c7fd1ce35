#include "bus/domain/own_sockets.hpp"

#include <arpa/inet.h>
#include <fmt/core.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <string>

#include "bus/domain/cyclone.hpp"

namespace trivela::bus {
namespace {

constexpr unsigned kFirstPort = 7400, kLastPort = 7400 + 250 * 101 - 1;  // RTPS 9.6.2.1

bool receives_all(int socket) {
  int type = 0;
  socklen_t size = sizeof type;
  if (getsockopt(socket, SOL_SOCKET, SO_TYPE, &type, &size) != 0 || type != SOCK_DGRAM) return false;
  sockaddr_in own{};
  size = sizeof own;
  if (getsockname(socket, reinterpret_cast<sockaddr*>(&own), &size) != 0 || own.sin_family != AF_INET) return false;
  const unsigned port = ntohs(own.sin_port);
  if (own.sin_addr.s_addr != htonl(INADDR_ANY) || port < kFirstPort || port > kLastPort) return false;
  std::array<char, 16> device{};
  size = device.size();
  return getsockopt(socket, SOL_SOCKET, SO_BINDTODEVICE, device.data(), &size) != 0 || size == 0;
}

}  // namespace

bool loopback_alone(std::string_view xml) {
  constexpr std::string_view kElement = "<NetworkInterface ";
  const auto first = xml.find(kElement);
  return first != std::string_view::npos && xml.find(kElement, first + 1) == std::string_view::npos &&
         xml.substr(first).starts_with(R"(<NetworkInterface name="lo")");
}

std::set<int> open_to_all() {
  std::set<int> found;
  std::error_code gone;
  for (const auto& entry : std::filesystem::directory_iterator{"/proc/self/fd", gone}) {
    const std::string name = entry.path().filename().string();
    int descriptor = -1;
    std::from_chars(name.data(), name.data() + name.size(), descriptor);
    if (descriptor >= 0 && receives_all(descriptor)) found.insert(descriptor);
  }
  return found;
}

void receive_loopback_only(int socket) {
  constexpr std::string_view kLoopback = "lo";
  if (setsockopt(socket, SOL_SOCKET, SO_BINDTODEVICE, kLoopback.data(), kLoopback.size()) != 0)
    throw Error("SO_BINDTODEVICE", "lo", std::strerror(errno));
}

}  // namespace trivela::bus
