#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <span>

namespace trivela::faults {

using Frame = std::span<std::uint8_t>;

/// Last byte of the MAC address that an Ethernet frame goes to; none: to everybody, or it is too short.
std::optional<std::uint8_t> receiver_of(std::span<const std::uint8_t> frame);

/// The payload of an unfragmented IPv4 UDP datagram; empty: it is something else.
Frame udp_payload(Frame frame);

/// Turns up to `most_bits` random bits of the UDP payload over and makes the checksum agree, so that no kernel sorts
/// the frame out. Whether there was something to turn.
bool garble(Frame frame, std::size_t most_bits, std::mt19937_64& random);

}  // namespace trivela::faults
