#include "tests/faults/own_network.hpp"

#include <fmt/core.h>
#include <net/if.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace trivela::faults {

void enter_own_network() {
  if (unshare(CLONE_NEWNET) != 0)
    throw std::runtime_error{fmt::format("no network of its own: {}", std::strerror(errno))};
  const int any_socket = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  ifreq loopback{};
  std::strcpy(loopback.ifr_name, "lo");
  loopback.ifr_flags = IFF_UP | IFF_LOOPBACK | IFF_RUNNING;
  const int failed = ioctl(any_socket, SIOCSIFFLAGS, &loopback);
  const int reason = errno;
  close(any_socket);
  if (failed != 0) throw std::runtime_error{fmt::format("loopback does not come up: {}", std::strerror(reason))};
}

}  // namespace trivela::faults
