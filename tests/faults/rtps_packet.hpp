#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace trivela::faults {

/// A part of an RTPS packet (OMG RTPS 2.2, 8.3): where it lies, and what it is.
struct Submessage {
  std::uint8_t id = 0;     ///< 0x06 ACKNACK, 0x07 HEARTBEAT, 0x08 GAP, 0x15 DATA, ...
  std::size_t begin = 0;   ///< of its header of four bytes, from the packet's beginning
  std::size_t end = 0;     ///< behind its last byte
  bool discovery = false;  ///< between builtin endpoints: participants, endpoints and their liveliness
};

/// Length of the packet's own header, whose bytes 8..19 are the sender's GUID prefix.
inline constexpr std::size_t kRtpsHeader = 20;

/// The submessages of an RTPS packet; none if it is none. A submessage longer than the packet ends with it.
std::vector<Submessage> submessages_of(std::span<const std::uint8_t> packet);

/// "ACKNACK" for 0x06 and so on; its number for one that is not in the standard.
std::string name_of_submessage(std::uint8_t id);

/// The number of the submessage with this name. Throws std::invalid_argument if there is none.
std::uint8_t submessage_named(const std::string& name);

}  // namespace trivela::faults
