#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace trivela::faults {

/// What a frame on the team's air carries.
enum class AirKind : std::uint8_t {
  kTeamState,        ///< data of more than 100 bytes between user endpoints
  kReferee,          ///< other data between user endpoints
  kAcknowledgement,  ///< no data between user endpoints: heartbeats and their answers; encrypted: all but data
  kDiscovery,        ///< between builtin endpoints: participants, endpoints, signs of life, handshakes
  kOther             ///< no RTPS: ARP, IGMP, ICMP
};
inline constexpr std::size_t kAirKinds = 5;

/// Frames that hosts sent, each once however many took it, with the headers of IP and UDP, as config/team/team_bus.hpp
/// counts.
struct AirMeter {
  struct Count {
    double frames = 0;
    double bytes = 0;
  };
  std::array<Count, kAirKinds> counts{};
  std::size_t longest = 0;  ///< bytes of a frame, with Ethernet's header

  void count(std::span<std::uint8_t> frame);
  const Count& of(AirKind kind) const { return counts[static_cast<std::size_t>(kind)]; }
  double bytes() const;
  double frames() const;
  /// The same with Ethernet's headers, 14 bytes a frame.
  double ethernet_bytes() const;
  AirMeter operator-(const AirMeter& before) const;
};

/// By kind: frames and kbit a second, their sum, and that with Ethernet's headers.
std::string air_table(const AirMeter& meter, double length_s);

}  // namespace trivela::faults
