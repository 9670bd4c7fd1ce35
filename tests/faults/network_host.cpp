#include "tests/faults/network_host.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <linux/if_tun.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <thread>

namespace trivela::faults {
namespace {

int checked(int result, const char* what) {
  if (result < 0) throw std::runtime_error{fmt::format("{}: {}", what, std::strerror(errno))};
  return result;
}

ifreq request_for(const char* interface) {
  ifreq request{};
  std::strncpy(request.ifr_name, interface, IFNAMSIZ - 1);
  return request;
}

sockaddr inet(const std::string& address) {
  sockaddr_in in{};
  in.sin_family = AF_INET;
  inet_pton(AF_INET, address.c_str(), &in.sin_addr);
  sockaddr out{};
  std::memcpy(&out, &in, sizeof out);
  return out;
}

void bring_up(int socket, const char* interface) {
  ifreq request = request_for(interface);
  request.ifr_flags = IFF_UP | IFF_RUNNING | IFF_MULTICAST;
  checked(ioctl(socket, SIOCSIFFLAGS, &request), interface);
}

void give_mac(int socket, const char* interface, std::uint8_t number) {
  ifreq mac = request_for(interface);
  mac.ifr_hwaddr.sa_family = ARPHRD_ETHER;
  const unsigned char bytes[6] = {2, 0, 0, 0, 0, number};
  std::memcpy(mac.ifr_hwaddr.sa_data, bytes, sizeof bytes);
  checked(ioctl(socket, SIOCSIFHWADDR, &mac), "MAC address");
}

void give_address_to(int socket, const char* interface, std::uint8_t number) {
  ifreq address = request_for(interface);
  address.ifr_addr = inet(fmt::format("10.77.0.{}", number));
  checked(ioctl(socket, SIOCSIFADDR, &address), "address");
  ifreq mask = request_for(interface);
  mask.ifr_netmask = inet("255.255.255.0");
  checked(ioctl(socket, SIOCSIFNETMASK, &mask), "netmask");
}

int open_cable() {
  const int cable = checked(open("/dev/net/tun", O_RDWR | O_NONBLOCK | O_CLOEXEC), "/dev/net/tun");
  ifreq request = request_for("tap0");
  request.ifr_flags = IFF_TAP | IFF_NO_PI;
  if (ioctl(cable, TUNSETIFF, &request) < 0) {
    const int error = errno;
    close(cable);
    throw std::runtime_error{fmt::format("tap0: {}", std::strerror(error))};
  }
  return cable;
}

/// Moves the calling thread into a network of its own and wires it up.
void enter_new_network(std::uint8_t number, int& cable, int& network) {
  checked(unshare(CLONE_NEWNET), "a network namespace");
  network = checked(open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC), "/proc/thread-self/ns/net");
  cable = open_cable();
  const int socket = checked(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0), "socket");
  bring_up(socket, "lo");
  give_mac(socket, "tap0", number);
  give_address_to(socket, "tap0", number);
  bring_up(socket, "tap0");
  close(socket);
}

}  // namespace

NetworkHost::NetworkHost(std::uint8_t number) : number_(number) {
  // A namespace belongs to a thread: this one goes, what it opened stays.
  std::exception_ptr failure;
  std::thread{[&] {
    try {
      enter_new_network(number, cable_, network_);
    } catch (...) {
      failure = std::current_exception();
    }
  }}.join();
  if (!failure) return;
  for (const int descriptor : {cable_, network_}) {
    if (descriptor >= 0) close(descriptor);
  }
  std::rethrow_exception(failure);
}

NetworkHost::NetworkHost(NetworkHost&& other) noexcept
    : number_(other.number_), cable_(other.cable_), network_(other.network_) {
  other.cable_ = other.network_ = -1;
}

NetworkHost::~NetworkHost() {
  for (const int descriptor : {cable_, network_}) {
    if (descriptor >= 0) close(descriptor);
  }
}

void on_host(const NetworkHost& host, const std::function<void()>& act) {
  std::exception_ptr failure;
  std::thread{[&] {
    try {
      checked(setns(host.network(), CLONE_NEWNET), "setns");
      act();
    } catch (...) {
      failure = std::current_exception();
    }
  }}.join();
  if (failure) std::rethrow_exception(failure);
}

namespace {

void with_socket(const NetworkHost& host, const auto& act) {
  on_host(host, [&] {
    const int socket = checked(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0), "socket");
    act(socket);
    close(socket);
  });
}

}  // namespace

void NetworkHost::lose_interface() const {
  with_socket(*this, [](int socket) {
    ifreq request = request_for("tap0");
    request.ifr_flags = 0;
    checked(ioctl(socket, SIOCSIFFLAGS, &request), "tap0 down");
  });
}

void NetworkHost::lose_address() const {
  with_socket(*this, [](int socket) {
    ifreq request = request_for("tap0");
    request.ifr_addr = inet("0.0.0.0");
    checked(ioctl(socket, SIOCSIFADDR, &request), "no address");
  });
}

void NetworkHost::give_address() const {
  with_socket(*this, [this](int socket) {
    give_address_to(socket, "tap0", number_);
    bring_up(socket, "tap0");
  });
}

std::string NetworkHost::obstacle() {
  try {
    const NetworkHost trial{250};
    return {};
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace trivela::faults
