#pragma once

#include <cstdint>
#include <vector>

#include "tests/faults/network_host.hpp"

namespace trivela::faults {

/// UDP payloads.
using Packets = std::vector<std::vector<std::uint8_t>>;

/// Hears every UDP packet on the loopback of a host, from its making on.
class Wiretap {
 public:
  /// Throws std::runtime_error where raw sockets are not permitted (they take CAP_NET_RAW).
  explicit Wiretap(const NetworkHost& host);
  Wiretap(const Wiretap&) = delete;
  Wiretap& operator=(const Wiretap&) = delete;
  ~Wiretap();

  /// What passed since the last call, each once. Never waits.
  Packets take();

 private:
  int socket_ = -1;
};

}  // namespace trivela::faults
