#include "emulators/can/emulated_bus.hpp"

#include <fmt/core.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "hal/line/descriptor.hpp"

namespace trivela::hal::can {
namespace {

class EmulatedBus final : public EmulatedSocket {
 public:
  EmulatedBus(const std::string& emulator, const std::string& device) : emulator_(emulator) {
    std::string folder = (std::filesystem::temp_directory_path() / ("trivela-" + emulator + "-XXXXXX")).string();
    if (::mkdtemp(folder.data()) == nullptr) refuse(folder.c_str());
    folder_ = folder;
    path_ = folder + "/" + device;
    plug();
  }
  ~EmulatedBus() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  void plug() override {
    sockaddr_un own{};
    own.sun_family = AF_UNIX;
    if (path_.size() >= sizeof own.sun_path) {
      errno = ENAMETOOLONG;
      refuse(path_.c_str());
    }
    std::memcpy(own.sun_path, path_.data(), path_.size());
    listener_.reset(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    if (!listener_ || ::bind(listener_.get(), reinterpret_cast<const sockaddr*>(&own), sizeof own) != 0 ||
        ::listen(listener_.get(), 4) != 0) {
      refuse(path_.c_str());
    }
  }

  void pull() noexcept override {
    client_.reset();
    listener_.reset();
    ::unlink(path_.c_str());
  }

  int listener() const override { return client_ ? -1 : listener_.get(); }
  void accept() override { client_.reset(::accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC)); }
  int client() const override { return client_.get(); }
  void hang_up() noexcept override { client_.reset(); }
  const std::string& address() const override { return path_; }

 private:
  [[noreturn]] void refuse(const char* what) const {
    throw std::runtime_error{fmt::format("{} emulator: {}: {}", emulator_, what, system_error(errno))};
  }

  std::string emulator_;
  std::filesystem::path folder_;
  std::string path_;
  Descriptor listener_;
  Descriptor client_;
};

}  // namespace

std::unique_ptr<EmulatedSocket> emulated_bus(const std::string& emulator, const std::string& device) {
  return std::make_unique<EmulatedBus>(emulator, device);
}

}  // namespace trivela::hal::can
