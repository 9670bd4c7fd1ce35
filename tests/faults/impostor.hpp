#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <string>

#include "tests/faults/network_host.hpp"
#include "tests/faults/wiretap.hpp"

namespace trivela::faults {

/// The kick_ids of an impostor's orders: from here, this many.
inline constexpr std::int64_t kForgedKick = 666'000;
inline constexpr int kForgedKicks = 20;

/// What a writer of kick_orders says that calls itself the decision of robot 1, is stronger than it and knows domain
/// and tag: its announcements, heartbeats and orders, taken from the loopback of a host of the attacker's, addressed to
/// whoever hears them.
Packets forged_orders(const NetworkHost& host, std::uint32_t domain_id, const std::string& tag);

/// Who speaks on the air: the first 12 bytes of each participant, as every RTPS message has them in clear.
using Prefix = std::array<std::uint8_t, 12>;
std::set<Prefix> speakers(const Packets& overheard);

/// A state of the team's bus that calls itself robot `robot_id` in another life, in clear, in the name of each of these
/// participants and of each of the first writers that one may have, by a later number than any of theirs.
Packets forged_states(const NetworkHost& host, std::uint8_t robot_id, const std::set<Prefix>& names);

/// Sends packets from a host, in their order, to the discovery and data ports of the first ten participants of a domain
/// at an address; a few times over, since what they announce has to be known before the rest counts.
void send_to_domain(const NetworkHost& host, const std::string& address, std::uint32_t domain_id,
                    const Packets& packets);

}  // namespace trivela::faults
