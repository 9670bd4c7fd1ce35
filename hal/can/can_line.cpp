#include "hal/can/can_line.hpp"

#include <fmt/core.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <functional>
#include <utility>

#include "hal/line/descriptor.hpp"

namespace trivela::hal::can {

Frame standard_frame(std::uint32_t id, std::initializer_list<std::uint8_t> data) {
  Frame frame{.id = id, .extended = false, .error = false, .size = static_cast<std::uint8_t>(data.size()), .data = {}};
  std::ranges::copy(data, frame.data.begin());
  return frame;
}

Frame extended_frame(std::uint32_t id, std::initializer_list<std::uint8_t> data) {
  Frame frame{.id = id, .extended = true, .error = false, .size = static_cast<std::uint8_t>(data.size()), .data = {}};
  std::ranges::copy(data, frame.data.begin());
  return frame;
}

std::string encode(const Frame& frame) {
  can_frame raw{};
  raw.can_id = frame.id | (frame.extended ? CAN_EFF_FLAG : 0U) | (frame.error ? CAN_ERR_FLAG : 0U);
  raw.can_dlc = frame.size;
  std::memcpy(raw.data, frame.data.data(), frame.data.size());
  return {reinterpret_cast<const char*>(&raw), sizeof raw};
}

std::vector<Frame> decode(std::string_view bytes) {
  std::vector<Frame> frames;
  for (; bytes.size() >= sizeof(can_frame); bytes.remove_prefix(sizeof(can_frame))) {
    can_frame raw{};
    std::memcpy(&raw, bytes.data(), sizeof raw);
    if (raw.can_dlc > CAN_MAX_DLEN || (raw.can_id & CAN_RTR_FLAG) != 0) continue;
    Frame frame;
    frame.extended = (raw.can_id & CAN_EFF_FLAG) != 0;
    frame.error = (raw.can_id & CAN_ERR_FLAG) != 0;
    frame.id = raw.can_id & (frame.extended || frame.error ? CAN_EFF_MASK : CAN_SFF_MASK);
    frame.size = raw.can_dlc;
    std::memcpy(frame.data.data(), raw.data, frame.size);
    frames.push_back(frame);
  }
  return frames;
}

Frame bus_off_frame() {
  return {.id = CAN_ERR_BUSOFF, .extended = false, .error = true, .size = CAN_ERR_DLC, .data = {}};
}

bool is_bus_off(const Frame& frame) { return frame.error && (frame.id & CAN_ERR_BUSOFF) != 0; }

std::string describe_error(const Frame& frame) {
  constexpr std::pair<std::uint32_t, const char*> kWords[] = {{CAN_ERR_BUSOFF, "bus off"},
                                                              {CAN_ERR_ACK, "no acknowledgement"},
                                                              {CAN_ERR_TX_TIMEOUT, "sending timed out"},
                                                              {CAN_ERR_CRTL, "controller problem"},
                                                              {CAN_ERR_PROT, "protocol violation"},
                                                              {CAN_ERR_TRX, "transceiver problem"},
                                                              {CAN_ERR_BUSERROR, "bus error"},
                                                              {CAN_ERR_RESTARTED, "restarted"},
                                                              {CAN_ERR_LOSTARB, "arbitration lost"}};
  std::string text;
  for (const auto& [bit, words] : kWords) {
    if ((frame.id & bit) != 0) text += (text.empty() ? "" : ", ") + std::string{words};
  }
  return text.empty() ? "unknown error" : text;
}

namespace {

class CanLine final : public Line {
 public:
  CanLine(const std::string& name, const std::string& host) : name_(name), host_(host) {}

  Opening open(Deadline) override {
    const bool emulated = name_.find('/') != std::string::npos;
    const bool ours = become_host();
    if (ours && (emulated ? open_socket() : open_interface())) return Opening::kOpen;
    why_ = !ours && errno == EADDRINUSE ? kTaken : system_error(errno);
    close();
    return Opening::kFailed;
  }
  std::optional<std::size_t> read(std::span<char> bytes, Deadline deadline) override {
    return fd_.read(bytes, deadline, why_);
  }
  bool write(std::string_view bytes, Deadline deadline) override { return fd_.write(bytes, deadline, why_); }
  void close() noexcept override {
    fd_.reset();
    lock_.reset();
  }
  int descriptor() const override { return fd_.get(); }
  const std::string& name() const override { return name_; }
  const std::string& why() const override { return why_; }

 private:
  /// Binds a name that the kernel gives once, and takes back when this process ends, however it does.
  bool become_host() {
    if (host_.empty()) return true;
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string text = fmt::format("trivela {} {:016x}", host_, std::hash<std::string>{}(name_));
    std::memcpy(address.sun_path + 1, text.data(), std::min(text.size(), sizeof address.sun_path - 1));
    lock_.reset(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
    return lock_ && ::bind(lock_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }

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
  std::string host_;
  std::string why_;
  Descriptor fd_;
  Descriptor lock_;
};

}  // namespace

std::unique_ptr<Line> can_line(const std::string& name, const std::string& host) {
  return std::make_unique<CanLine>(name, host);
}

}  // namespace trivela::hal::can
