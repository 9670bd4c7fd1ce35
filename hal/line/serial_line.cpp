#include <fcntl.h>
#include <sys/file.h>
#include <termios.h>

#include <cerrno>

#include "hal/line/descriptor.hpp"
#include "hal/line/line.hpp"

namespace trivela::hal {
namespace {

class SerialLine final : public Line {
 public:
  explicit SerialLine(const std::string& path) : path_(path) {}

  Opening open(Deadline) override {
    fd_.reset(::open(path_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
    const bool ours = fd_ && ::flock(fd_.get(), LOCK_EX | LOCK_NB) == 0;
    if (ours && make_raw()) return Opening::kOpen;
    why_ = !ours && errno == EWOULDBLOCK ? kTaken : system_error(errno);
    fd_.reset();
    return Opening::kFailed;
  }

  std::optional<std::size_t> read(std::span<char> bytes, Deadline deadline) override {
    return fd_.read(bytes, deadline, why_);
  }
  bool write(std::string_view bytes, Deadline deadline) override { return fd_.write(bytes, deadline, why_); }
  void drop_unsent() noexcept override { ::tcflush(fd_.get(), TCOFLUSH); }
  void close() noexcept override { fd_.reset(); }
  int descriptor() const override { return fd_.get(); }
  const std::string& name() const override { return path_; }
  const std::string& why() const override { return why_; }

 private:
  bool make_raw() const {
    termios settings{};
    if (::tcgetattr(fd_.get(), &settings) != 0) return false;
    ::cfmakeraw(&settings);
    settings.c_cflag |= CLOCAL | CREAD;
    settings.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
    settings.c_cc[VMIN] = 1;  // so that 0 bytes mean that it was hung up
    settings.c_cc[VTIME] = 0;
    ::cfsetspeed(&settings, B115200);
    if (::tcsetattr(fd_.get(), TCSANOW, &settings) != 0) return false;
    ::tcflush(fd_.get(), TCIOFLUSH);  // what an earlier host left unread
    return true;
  }

  std::string path_;
  std::string why_;
  Descriptor fd_;
};

}  // namespace

std::unique_ptr<Line> serial_line(const std::string& path) { return std::make_unique<SerialLine>(path); }

}  // namespace trivela::hal
