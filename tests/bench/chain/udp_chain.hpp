#pragma once

#include <vector>

#include "tests/bench/chain/contender.hpp"

namespace trivela::bench {

/// Four processes over connected UDP sockets of the loopback device with blocking receives; each datagram is the C
/// struct of the message that the bus would carry there. Makes the sockets now, for the children to inherit.
std::vector<Contender::Process> udp_chain();

}  // namespace trivela::bench
