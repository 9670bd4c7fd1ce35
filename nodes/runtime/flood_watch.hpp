#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <thread>

#include "bus/stop.hpp"

namespace trivela::nodes {

/// What this process has of the memory, in bytes.
std::int64_t resident_bytes();

/// Looks, once a poll interval, for what unknown participants can do to Cyclone in this process before their signature
/// is checked:
///
/// - memory: discovery remembers each participant for as long as its announcement asks, so that it can grow without
///   end; the kernel would then end any process, the recorder too.
/// - handshakes: a participant that does not answer for 100 s can break the list of timers that handshakes wait in
///   (Cyclone 0.10.2, mended upstream by 46c70421). Their thread then runs without end, or the process crashes; known
///   participants are still received, new ones are not.
class FloodWatch {
 public:
  using Tell = std::function<void(const std::string& why)>;

  /// Cyclone's name for the thread of a member's handshakes (src/security/core/src/dds_security_fsm.c).
  static constexpr const char* kHandshakes = "fsm";

  /// Beyond the limit, or where the handshakes' thread has run and not paused for ten polls, it requests the stop and
  /// tells why, in its own thread. Where the process has not ended within `grace`, since a participant of such a
  /// library may never be deleted, or takes twice the limit, it ends it with exit code 1. Memory that is free is given
  /// back to the system at every tenth interval where the process has grown.
  FloodWatch(std::uint32_t limit_mb, bus::Stop& stop, Tell tell,
             std::chrono::milliseconds interval = std::chrono::seconds{1},
             std::chrono::milliseconds grace = std::chrono::seconds{10});
  FloodWatch(const FloodWatch&) = delete;
  FloodWatch& operator=(const FloodWatch&) = delete;
  ~FloodWatch();

  /// From now on nothing is given back: locked pages stay.
  void memory_is_locked() noexcept { gives_back_ = false; }

  /// Whether it requested the stop.
  bool ended() const noexcept { return ended_; }

 private:
  struct Turns {
    std::int64_t pauses = 0;
    std::int64_t ran_ns = 0;
  };

  void look();
  void end(const std::string& why);
  std::string fault();
  bool handshakes_turn();

  const std::int64_t start_bytes_ = resident_bytes();
  const std::uint32_t limit_mb_;
  bus::Stop& stop_;
  const Tell tell_;
  const std::chrono::milliseconds interval_, grace_;
  int polls_ = 0;
  std::map<std::string, Turns> handshakes_;  // by thread
  std::atomic<bool> gives_back_ = true, ended_ = false;
  bus::Stop over_;
  std::thread thread_;
};

}  // namespace trivela::nodes
