#pragma once

#include <string>
#include <vector>

#include "bus/domain/domain.hpp"
#include "monitor/network/readings.hpp"

namespace trivela::monitor::network {

/// What `gather` looks at.
struct Subject {
  bus::DomainConfig domain;
  std::string interface;  ///< name or address; empty: what the DDS configuration names, unless that is loopback
  std::vector<std::string> peers;
};

/// The first interface that a Cyclone configuration names, by name or address; empty: none.
std::string interface_of(const std::string& xml);

/// Reads this machine and its network, in 2 s and half a second a silent peer. Writes to no topic.
Readings gather(const Subject& subject);

}  // namespace trivela::monitor::network
