#pragma once

#include <optional>
#include <set>

#include "monitor/network/readings.hpp"

namespace trivela::monitor::network {

/// Those of these ports on which a UDP socket of this machine hears every interface: bound to no address (0.0.0.0) and
/// to no interface. None: the kernel does not say (sock_diag).
std::optional<std::set<unsigned>> open_ports(Ports ports);

}  // namespace trivela::monitor::network
