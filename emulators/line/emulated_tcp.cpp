#include <fmt/core.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <cerrno>
#include <stdexcept>

#include "emulators/line/emulated_socket.hpp"

namespace trivela::hal {
namespace {

class EmulatedTcp final : public EmulatedSocket {
 public:
  EmulatedTcp(const std::string& emulator, std::uint16_t port) : emulator_(emulator), port_(port) {
    bind();
    plug();
    address_ = fmt::format("tcp://127.0.0.1:{}", port_);
  }

  void plug() override {
    if (::listen(listener_.get(), 4) != 0) refuse("listen");
    listening_ = true;
  }

  void pull() noexcept override {
    hang_up();
    listener_.reset();
    listening_ = false;
    try {
      bind();  // and not listening: nobody else gets the port meanwhile
    } catch (const std::runtime_error&) {
      listener_.reset();  // plug() will say it
    }
  }

  int listener() const override { return listening_ && !client_ ? listener_.get() : -1; }
  void accept() override {
    client_.reset(::accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    const int at_once = 1;
    ::setsockopt(client_.get(), IPPROTO_TCP, TCP_NODELAY, &at_once, sizeof at_once);
  }
  int client() const override { return client_.get(); }
  void hang_up() noexcept override { client_.reset(); }
  const std::string& address() const override { return address_; }

 private:
  void bind() {
    listener_.reset(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    const int reuse = 1;
    ::setsockopt(listener_.get(), SOL_SOCKET, SO_REUSEADDR, &reuse, sizeof reuse);
    sockaddr_in own{};
    own.sin_family = AF_INET;
    own.sin_port = htons(port_);
    own.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof own;
    auto* const address = reinterpret_cast<sockaddr*>(&own);
    if (::bind(listener_.get(), address, size) != 0 || ::getsockname(listener_.get(), address, &size) != 0) {
      refuse("bind");
    }
    port_ = ntohs(own.sin_port);
  }

  [[noreturn]] void refuse(const char* what) const {
    throw std::runtime_error{fmt::format("{} emulator: {} port {}: {}", emulator_, what, port_, system_error(errno))};
  }

  std::string emulator_;
  std::uint16_t port_;
  std::string address_;
  Descriptor listener_;
  bool listening_ = false;
  Descriptor client_;
};

}  // namespace

std::unique_ptr<EmulatedSocket> emulated_tcp(const std::string& emulator, std::uint16_t port) {
  return std::make_unique<EmulatedTcp>(emulator, port);
}

}  // namespace trivela::hal
