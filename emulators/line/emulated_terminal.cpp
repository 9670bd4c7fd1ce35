#include <fcntl.h>
#include <fmt/core.h>
#include <stdlib.h>
#include <termios.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <stdexcept>

#include "emulators/line/emulated_socket.hpp"

namespace trivela::hal {
namespace {

namespace fs = std::filesystem;

class EmulatedTerminal final : public EmulatedSocket {
 public:
  EmulatedTerminal(const std::string& emulator, const std::string& device) : emulator_(emulator) {
    std::string folder = (fs::temp_directory_path() / ("trivela-" + emulator + "-XXXXXX")).string();
    if (::mkdtemp(folder.data()) == nullptr) refuse(folder.c_str());
    folder_ = folder;
    link_ = folder + "/" + device;
    plug();
  }
  ~EmulatedTerminal() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
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
    fs::create_symlink(path.data(), link_);
    terminal_ = std::move(terminal);
    other_end_ = std::move(other_end);
  }

  void pull() noexcept override {
    std::error_code ignored;
    fs::remove(link_, ignored);
    other_end_.reset();
    terminal_.reset();
  }

  int listener() const override { return -1; }
  void accept() override {}
  int client() const override { return terminal_.get(); }
  void hang_up() noexcept override {}
  const std::string& address() const override { return link_; }

 private:
  [[noreturn]] void refuse(const char* what) const {
    throw std::runtime_error{fmt::format("{} emulator: {}: {}", emulator_, what, system_error(errno))};
  }

  std::string emulator_;
  fs::path folder_;
  std::string link_;
  Descriptor terminal_;
  Descriptor other_end_;
};

}  // namespace

std::unique_ptr<EmulatedSocket> emulated_terminal(const std::string& emulator, const std::string& device) {
  return std::make_unique<EmulatedTerminal>(emulator, device);
}

}  // namespace trivela::hal
