#include "monitor/network/gather.hpp"

#include <arpa/inet.h>
#include <linux/inet_diag.h>
#include <linux/netlink.h>
#include <linux/sock_diag.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>

namespace trivela::monitor::network {
namespace {

class DiagSocket {
 public:
  DiagSocket() : descriptor_(socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_SOCK_DIAG)) {
    const timeval timeout{.tv_sec = 1, .tv_usec = 0};
    setsockopt(descriptor_, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
  }
  DiagSocket(const DiagSocket&) = delete;
  DiagSocket& operator=(const DiagSocket&) = delete;
  ~DiagSocket() {
    if (descriptor_ >= 0) close(descriptor_);
  }

  /// Asks for every UDP socket of IPv4.
  bool ask() const {
    struct {
      nlmsghdr header;
      inet_diag_req_v2 wanted;
    } request{};
    request.header.nlmsg_len = sizeof request;
    request.header.nlmsg_type = SOCK_DIAG_BY_FAMILY;
    request.header.nlmsg_flags = NLM_F_REQUEST | NLM_F_DUMP;
    request.wanted.sdiag_family = AF_INET;
    request.wanted.sdiag_protocol = IPPROTO_UDP;
    request.wanted.idiag_states = ~0u;
    return send(descriptor_, &request, sizeof request, 0) == static_cast<ssize_t>(sizeof request);
  }

  template <std::size_t N>
  ssize_t receive(std::array<char, N>& answer) const {
    return recv(descriptor_, answer.data(), answer.size(), 0);
  }

 private:
  int descriptor_;
};

}  // namespace

std::optional<std::set<unsigned>> open_ports(Ports ports) {
  const DiagSocket kernel;
  if (!kernel.ask()) return std::nullopt;
  std::set<unsigned> found;
  alignas(nlmsghdr) std::array<char, 32768> answer{};
  for (;;) {
    const ssize_t size = kernel.receive(answer);
    if (size <= 0) return std::nullopt;
    auto left = static_cast<unsigned>(size);
    for (auto* part = reinterpret_cast<nlmsghdr*>(answer.data()); NLMSG_OK(part, left); part = NLMSG_NEXT(part, left)) {
      if (part->nlmsg_type == NLMSG_DONE) return found;
      if (part->nlmsg_type == NLMSG_ERROR) return std::nullopt;
      const auto& id = static_cast<const inet_diag_msg*>(NLMSG_DATA(part))->id;
      const unsigned port = ntohs(id.idiag_sport);
      if (port >= ports.first && port <= ports.last && id.idiag_src[0] == 0 && id.idiag_if == 0) found.insert(port);
    }
  }
}

}  // namespace trivela::monitor::network
