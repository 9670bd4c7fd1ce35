#pragma once

#include <atomic>
#include <cstdint>
#include <random>
#include <span>
#include <thread>
#include <vector>

namespace trivela::faults {

/// What a mutator does to the packets that pass.
struct Mutations {
  std::uint64_t seed = 1;
  double share = 1.0;                ///< of the packets that pass are answered with a mutated copy, 0..1
  std::uint32_t most_flips = 3;      ///< bits of a copy that are turned over: 1 to so many
  std::vector<std::uint8_t> only{};  ///< bytes of these submessages alone (rtps_packet.hpp); empty: of any
  std::size_t from = 0;              ///< of such a submessage the bytes from here, counted from its header
  std::size_t to = SIZE_MAX;         ///< up to before here
  bool discovery = true;             ///< submessages between builtin endpoints, too
  bool user_data = true;             ///< those between all other endpoints, too
};

/// Listens on the loopback interface for the RTPS packets of others, turns bits of copies over, and sends these to
/// where the packets went. What it does depends on the seed and the packets alone.
class PacketMutator {
 public:
  /// Begins at once. Throws std::runtime_error where raw sockets are not permitted (they take CAP_NET_RAW).
  explicit PacketMutator(const Mutations& mutations);
  PacketMutator(const PacketMutator&) = delete;
  PacketMutator& operator=(const PacketMutator&) = delete;
  ~PacketMutator() { stop(); }

  /// No copy is sent any more once it returns. May be called again.
  void stop();

  std::uint64_t seen() const { return seen_; }  ///< packets that passed
  std::uint64_t sent() const { return sent_; }  ///< mutated copies

 private:
  void run();
  void take(std::span<std::uint8_t> frame);
  bool mutate(std::span<std::uint8_t> packet);
  bool wanted(const struct Submessage& part) const;

  Mutations mutations_;
  std::mt19937_64 random_;
  int tap_ = -1;
  int out_ = -1;
  int stop_ = -1;
  std::uint16_t own_port_ = 0;
  std::atomic<std::uint64_t> seen_ = 0;
  std::atomic<std::uint64_t> sent_ = 0;
  std::thread thread_;
};

}  // namespace trivela::faults
