#include "hal/line/line.hpp"

#include <fcntl.h>
#include <linux/sockios.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <termios.h>

#include <cerrno>
#include <cstring>
#include <future>
#include <thread>
#include <vector>

#include "hal/line/descriptor.hpp"

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

namespace {

struct Address {
  sockaddr_storage storage{};
  socklen_t size = 0;
};

struct Lookup {
  std::vector<Address> addresses;
  std::string why;
};

Lookup look_up(const std::string& host, const std::string& port) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  Lookup lookup;
  if (const int error = ::getaddrinfo(host.c_str(), port.c_str(), &hints, &found); error != 0) {
    lookup.why = ::gai_strerror(error);
    return lookup;
  }
  for (const addrinfo* entry = found; entry != nullptr; entry = entry->ai_next) {
    Address address;
    std::memcpy(&address.storage, entry->ai_addr, entry->ai_addrlen);
    address.size = entry->ai_addrlen;
    lookup.addresses.push_back(address);
  }
  ::freeaddrinfo(found);
  return lookup;
}

// getaddrinfo() may take as long as it likes: it gets a thread that nobody waits for.
std::future<Lookup> start_look_up(const std::string& host, const std::string& port) {
  std::packaged_task<Lookup()> task{[host, port] { return look_up(host, port); }};
  auto future = task.get_future();
  std::thread{std::move(task)}.detach();
  return future;
}

class TcpLine final : public Line {
 public:
  TcpLine(const std::string& host, std::uint16_t port)
      : host_(host),
        port_(std::to_string(port)),
        name_("tcp://" + (host.find(':') == std::string::npos ? host : "[" + host + "]") + ":" + port_) {}

  Opening open(Deadline deadline) override {
    if (fd_) return go_on(deadline);
    if (!future_.valid()) future_ = start_look_up(host_, port_);
    if (future_.wait_until(deadline) != std::future_status::ready) {
      why_ = "the host's name is still being looked up";
      return Opening::kPending;
    }
    const Lookup lookup = future_.get();
    if (lookup.addresses.empty()) {
      why_ = lookup.why;
      return Opening::kFailed;
    }
    // A host of several addresses is tried at the next one each time.
    return connect(lookup.addresses[attempt_++ % lookup.addresses.size()], deadline);
  }

  std::optional<std::size_t> read(std::span<char> bytes, Deadline deadline) override {
    return fd_.read(bytes, deadline, why_);
  }
  bool write(std::string_view bytes, Deadline deadline) override { return fd_.write(bytes, deadline, why_); }
  std::size_t unacknowledged_bytes() const override {
    int waiting_bytes = 0;
    return fd_ && ::ioctl(fd_.get(), SIOCOUTQ, &waiting_bytes) == 0 && waiting_bytes > 0
               ? static_cast<std::size_t>(waiting_bytes)
               : 0;
  }
  void close() noexcept override { fd_.reset(); }
  int descriptor() const override { return fd_.get(); }
  const std::string& name() const override { return name_; }
  const std::string& why() const override { return why_; }

 private:
  Opening connect(const Address& address, Deadline deadline) {
    fd_.reset(::socket(address.storage.ss_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    if (!fd_) return fail(errno);
    const int at_once = 1;
    ::setsockopt(fd_.get(), IPPROTO_TCP, TCP_NODELAY, &at_once, sizeof at_once);
    if (::connect(fd_.get(), reinterpret_cast<const sockaddr*>(&address.storage), address.size) == 0) {
      return Opening::kOpen;
    }
    return errno == EINPROGRESS ? go_on(deadline) : fail(errno);
  }

  Opening go_on(Deadline deadline) {
    if (fd_.wait(POLLOUT, deadline) == 0) {
      why_ = "it does not answer";
      return Opening::kPending;
    }
    int error = 0;
    socklen_t size = sizeof error;
    ::getsockopt(fd_.get(), SOL_SOCKET, SO_ERROR, &error, &size);
    return error == 0 ? Opening::kOpen : fail(error);
  }

  Opening fail(int error) {
    why_ = system_error(error);
    fd_.reset();
    return Opening::kFailed;
  }

  std::string host_;
  std::string port_;
  std::string name_;
  std::string why_;
  std::future<Lookup> future_;
  std::size_t attempt_ = 0;
  Descriptor fd_;
};

}  // namespace

std::unique_ptr<Line> tcp_line(const std::string& host, std::uint16_t port) {
  return std::make_unique<TcpLine>(host, port);
}

}  // namespace trivela::hal
