#include "emulators/line/emulated_socket.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

namespace trivela::hal {
namespace {

namespace fs = std::filesystem;

/// One under a path in a folder of its own.
class SocketInFolder : public EmulatedSocket {
 public:
  SocketInFolder(const std::string& emulator, const std::string& device) : emulator_(emulator) {
    std::string folder = (fs::temp_directory_path() / ("trivela-" + emulator + "-XXXXXX")).string();
    if (::mkdtemp(folder.data()) == nullptr) refuse(folder.c_str());
    folder_ = folder;
    path_ = folder + "/" + device;
  }
  ~SocketInFolder() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  const std::string& address() const override { return path_; }

 protected:
  [[noreturn]] void refuse(const char* what) const {
    throw std::runtime_error{fmt::format("{} emulator: {}: {}", emulator_, what, system_error(errno))};
  }

 private:
  std::string emulator_;
  fs::path folder_;
  std::string path_;
};

class EmulatedTerminal final : public SocketInFolder {
 public:
  EmulatedTerminal(const std::string& emulator, const std::string& device) : SocketInFolder(emulator, device) {
    plug();
  }

  void plug() override {
    Descriptor terminal{::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)};
    std::array<char, 128> path{};
    if (!terminal || ::grantpt(terminal.get()) != 0 || ::unlockpt(terminal.get()) != 0 ||
        ::ptsname_r(terminal.get(), path.data(), path.size()) != 0) {
      refuse("no pseudo-terminal");
    }
    // Held open, so that the line does not hang up when a client goes, and raw before the first comes.
    Descriptor other_end{::open(path.data(), O_RDWR | O_NOCTTY | O_CLOEXEC)};
    termios settings{};
    if (!other_end || ::tcgetattr(other_end.get(), &settings) != 0) refuse(path.data());
    ::cfmakeraw(&settings);
    if (::tcsetattr(other_end.get(), TCSANOW, &settings) != 0) refuse(path.data());
    fs::create_symlink(path.data(), address());
    terminal_ = std::move(terminal);
    other_end_ = std::move(other_end);
  }

  void pull() noexcept override {
    std::error_code ignored;
    fs::remove(address(), ignored);
    other_end_.reset();
    terminal_.reset();
  }

  int listener() const override { return -1; }
  void accept() override {}
  int client() const override { return terminal_.get(); }
  void hang_up() noexcept override {}

 private:
  Descriptor terminal_;
  Descriptor other_end_;
};

class EmulatedBus final : public SocketInFolder {
 public:
  EmulatedBus(const std::string& emulator, const std::string& device) : SocketInFolder(emulator, device) { plug(); }

  void plug() override {
    sockaddr_un own{};
    own.sun_family = AF_UNIX;
    if (address().size() >= sizeof own.sun_path) {
      errno = ENAMETOOLONG;
      refuse(address().c_str());
    }
    std::memcpy(own.sun_path, address().data(), address().size());
    listener_.reset(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    if (!listener_ || ::bind(listener_.get(), reinterpret_cast<const sockaddr*>(&own), sizeof own) != 0 ||
        ::listen(listener_.get(), 4) != 0) {
      refuse(address().c_str());
    }
  }

  void pull() noexcept override {
    client_.reset();
    listener_.reset();
    ::unlink(address().c_str());
  }

  int listener() const override { return client_ ? -1 : listener_.get(); }
  void accept() override { client_.reset(::accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC)); }
  int client() const override { return client_.get(); }
  void hang_up() noexcept override { client_.reset(); }

 private:
  Descriptor listener_;
  Descriptor client_;
};

}  // namespace

std::unique_ptr<EmulatedSocket> emulated_terminal(const std::string& emulator, const std::string& device) {
  return std::make_unique<EmulatedTerminal>(emulator, device);
}

std::unique_ptr<EmulatedSocket> emulated_bus(const std::string& emulator, const std::string& device) {
  return std::make_unique<EmulatedBus>(emulator, device);
}

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
