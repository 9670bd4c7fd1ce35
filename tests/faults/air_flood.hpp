#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <mutex>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "tests/faults/network_host.hpp"
#include "tests/faults/wiretap.hpp"

namespace trivela::faults {

/// Sends what it overheard, and what it makes of it, from a host that is no member of the team's bus to every port of
/// it: in turn a packet as it was, one with bits turned over, one of random bytes behind an RTPS header, and the
/// announcement of a participant that is not there; or such announcements alone. It never waits.
class AirFlood {
 public:
  enum Kind {
    kAll,
    kUndying,  ///< announcements alone, of participants that want to be remembered for ever
  };

  /// Packets that it remembers.
  static constexpr std::size_t kRemembered = 256;

  /// `targets`: addresses, of which each domain's ports of discovery and of so many participants are sent to. Begins at
  /// once.
  AirFlood(const NetworkHost& host, std::vector<std::string> targets, std::uint32_t domain_id,
           std::uint16_t participants, Packets overheard, std::uint64_t seed, Kind kind = kAll);
  AirFlood(const AirFlood&) = delete;
  AirFlood& operator=(const AirFlood&) = delete;
  ~AirFlood();

  std::uint64_t sent() const { return sent_; }

  /// The last kRemembered packets, each once however many ports it went to, the newest last.
  Packets last() const;

 private:
  void run();
  const std::vector<std::uint8_t>& any() { return overheard_[random_() % overheard_.size()]; }
  void scramble(std::vector<std::uint8_t>& packet, std::size_t from, std::size_t to);
  std::vector<std::uint8_t> unknown_participant();
  std::vector<std::uint8_t> next();

  const std::vector<std::string> targets_;
  std::vector<std::uint16_t> ports_;
  const Packets overheard_;
  const Kind kind_;
  std::mt19937_64 random_;
  std::uint64_t turn_ = 0;
  int socket_ = -1;
  mutable std::mutex mutex_;
  std::deque<std::vector<std::uint8_t>> last_;  // under the mutex
  std::atomic<bool> stop_ = false;
  std::atomic<std::uint64_t> sent_ = 0;
  std::thread thread_;
};

/// Resident memory of a process in bytes; 0: it is gone.
std::int64_t resident_bytes(int pid);

/// Packets as lines of hexadecimal digits behind `heading`, for the search of the one that ended a node.
void keep_packets(const std::filesystem::path& file, const std::string& heading, const Packets& packets);

}  // namespace trivela::faults
