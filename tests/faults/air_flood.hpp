#pragma once

#include <atomic>
#include <cstdint>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "tests/faults/network_host.hpp"

namespace trivela::faults {

/// Sends what it overheard, and what it makes of it, from a host that is no member of the team's bus to every port of
/// it: in turn a packet as it was, one with bits turned over, one of random bytes behind an RTPS header, and the
/// announcement of a participant that is not there. It never waits.
class AirFlood {
 public:
  using Packets = std::vector<std::vector<std::uint8_t>>;

  /// `targets`: addresses; `first_port`: of the DDS domain. Begins at once.
  AirFlood(const NetworkHost& host, std::vector<std::string> targets, std::uint16_t first_port, Packets overheard,
           std::uint64_t seed);
  AirFlood(const AirFlood&) = delete;
  AirFlood& operator=(const AirFlood&) = delete;
  ~AirFlood();

  std::uint64_t sent() const { return sent_; }

 private:
  void run();
  std::vector<std::uint8_t> next();

  const std::vector<std::string> targets_;
  const std::uint16_t first_port_;
  const Packets overheard_;
  std::mt19937_64 random_;
  std::uint64_t turn_ = 0;
  int socket_ = -1;
  std::atomic<bool> stop_ = false;
  std::atomic<std::uint64_t> sent_ = 0;
  std::thread thread_;
};

/// Resident memory of a process in bytes; 0: it is gone.
std::int64_t resident_bytes(int pid);

}  // namespace trivela::faults
