#include "hal/can/can_line.hpp"

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <cerrno>
#include <cstring>

#include "hal/line/descriptor.hpp"

namespace trivela::hal::can {
namespace {

class CanLine final : public Line {
 public:
  explicit CanLine(const std::string& name) : name_(name) {}

  Opening open(Deadline) override {
    const bool emulated = name_.find('/') != std::string::npos;
    if (emulated ? open_socket() : open_interface()) return Opening::kOpen;
    why_ = system_error(errno);
    fd_.reset();
    return Opening::kFailed;
  }
  std::optional<std::size_t> read(std::span<char> bytes, Deadline deadline) override {
    return fd_.read(bytes, deadline, why_);
  }
  bool write(std::string_view bytes, Deadline deadline) override { return fd_.write(bytes, deadline, why_); }
  void close() noexcept override { fd_.reset(); }
  int descriptor() const override { return fd_.get(); }
  const std::string& name() const override { return name_; }
  const std::string& why() const override { return why_; }

 private:
  bool open_interface() {
    fd_.reset(::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW));
    if (!fd_) return false;
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(::if_nametoindex(name_.c_str()));
    if (address.can_ifindex == 0) return false;
    const can_err_mask_t every_error = CAN_ERR_MASK;
    ::setsockopt(fd_.get(), SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &every_error, sizeof every_error);
    return ::bind(fd_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }

  bool open_socket() {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (name_.size() >= sizeof address.sun_path) {
      errno = ENAMETOOLONG;
      return false;
    }
    std::memcpy(address.sun_path, name_.data(), name_.size());
    fd_.reset(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    return fd_ && ::connect(fd_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }

  std::string name_;
  std::string why_;
  Descriptor fd_;
};

}  // namespace

std::unique_ptr<Line> can_line(const std::string& name) { return std::make_unique<CanLine>(name); }

}  // namespace trivela::hal::can
