#pragma once

#include <cstdint>
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

/// Sends packets from a host, in their order, to the discovery and data ports of the first ten participants of a domain
/// at an address; a few times over, since what they announce has to be known before the rest counts.
void send_to_domain(const NetworkHost& host, const std::string& address, std::uint32_t domain_id,
                    const Packets& packets);

}  // namespace trivela::faults
