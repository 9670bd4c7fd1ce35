#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "tests/faults/air_meter.hpp"
#include "tests/faults/rtps_writer.hpp"

namespace trivela::faults {

/// What the way from one host to another does to frames.
struct Way {
  std::chrono::microseconds delay{0};
  std::chrono::microseconds jitter{0};  ///< at most so much more, drawn again for each frame: they overtake each other
  double drop = 0.0;                    ///< share of frames that never arrive; 1: cut
  double garble = 0.0;                  ///< share of UDP datagrams with bits turned over
};

/// (from, to) by place in the hub's list of cables. What is not named is sound.
using Ways = std::map<std::pair<std::size_t, std::size_t>, Way>;

/// How many frames the hub has treated so since it began.
struct HubCounts {
  std::uint64_t forwarded = 0;
  std::uint64_t delayed = 0;
  std::uint64_t dropped = 0;
  std::uint64_t garbled = 0;
};

/// A frame as it was handed to a host with bits turned over.
struct GarbledFrame {
  std::int64_t arrival_ns = 0;  ///< CLOCK_MONOTONIC
  std::vector<std::uint8_t> bytes;
};

/// Joins the cables of NetworkHosts in a thread of its own: frames to everybody go to everybody, others to the host
/// whose number is their MAC address's last byte.
class Hub {
 public:
  struct Cable {
    int descriptor = -1;
    std::uint8_t number = 0;
  };

  /// The cables must outlive it. Throws std::system_error if no thread can be had.
  Hub(std::vector<Cable> cables, std::uint64_t seed);
  Hub(const Hub&) = delete;
  Hub& operator=(const Hub&) = delete;
  ~Hub();

  /// From now on the ways are these.
  void set(Ways ways);

  /// What this writer says comes to the host at place `listener` alone, whatever the ways are.
  void confine(const Guid& writer, std::size_t listener);

  HubCounts counts() const;

  /// The UDP payloads that hosts sent last, as anybody on the air has them.
  std::vector<std::vector<std::uint8_t>> overheard() const;

  /// What hosts have sent, by what it carries.
  AirMeter meter() const;

  /// Keeps what is garbled on its way to the host at place `to`, from now on.
  void keep_garbled(std::size_t to);
  std::vector<GarbledFrame> garbled() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace trivela::faults
