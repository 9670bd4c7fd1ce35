#include "tests/bench/chain/udp_chain.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <memory>
#include <stdexcept>

#include "bus/stop.hpp"
#include "idl/messages.hpp"
#include "tests/bench/chain/pacer.hpp"

namespace trivela::bench {
namespace {

// Both ends of one hop.
class Hop {
 public:
  Hop() : in_(socket(AF_INET, SOCK_DGRAM, 0)), out_(socket(AF_INET, SOCK_DGRAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* generic = reinterpret_cast<sockaddr*>(&address);
    if (bind(in_, generic, size) != 0 || getsockname(in_, generic, &size) != 0 || connect(out_, generic, size) != 0)
      throw std::runtime_error("no UDP socket on the loopback device");
  }
  Hop(const Hop&) = delete;
  Hop& operator=(const Hop&) = delete;
  ~Hop() {
    close(in_);
    close(out_);
  }

  template <class T>
  void send(const T& message) const {
    if (::send(out_, &message, sizeof message, 0) != sizeof message) throw std::runtime_error("send failed");
  }
  template <class T>
  T receive() const {
    T message;
    if (recv(in_, &message, sizeof message, 0) != sizeof message) throw std::runtime_error("receive failed");
    return message;
  }

 private:
  int in_, out_;
};

}  // namespace

std::vector<Contender::Process> udp_chain() {
  // SIGTERM ends a process where it stands: it owns nothing that others would miss.
  const auto first = std::make_shared<Hop>(), second = std::make_shared<Hop>(), third = std::make_shared<Hop>();
  return {[first](Track& track) {
            for (Pacer pacer(track);;) {
              const auto tick = pacer.next(std::chrono::hours(1));
              if (!tick) continue;
              msg::Odometry odometry{};
              odometry.seq = static_cast<std::uint64_t>(tick->seq);
              odometry.t_ns = tick->t_ns;
              first->send(odometry);
            }
          },
          [first, second](Track&) {
            for (;;) {
              const auto odometry = first->receive<msg::Odometry>();
              msg::WorldState state{};
              state.seq = odometry.seq;
              state.t_ns = odometry.t_ns;
              second->send(state);
            }
          },
          [second, third](Track&) {
            for (;;) {
              const auto state = second->receive<msg::WorldState>();
              msg::KickOrder order{};
              order.seq = state.seq;
              order.t_ns = state.t_ns;
              third->send(order);
            }
          },
          [third](Track& track) {
            for (;;) {
              const auto order = third->receive<msg::KickOrder>();
              track.arrived(static_cast<std::int64_t>(order.seq), order.t_ns);
            }
          }};
}

}  // namespace trivela::bench
