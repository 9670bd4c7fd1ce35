#pragma once

#include <fmt/core.h>
#include <unistd.h>

#include <atomic>
#include <string>

#include "bus/domain/domain.hpp"

namespace trivela::bus {

/// A domain and tag that no other test has: test programs run at the same time. Domain 0 is left to people.
inline DomainConfig fresh_domain() {
  static std::atomic<unsigned> count = 0;
  const unsigned n = count++;
  const auto pid = static_cast<unsigned>(getpid());
  return loopback(1 + (pid * 7 + n) % 100, fmt::format("test-{}-{}", pid, n));
}

/// Two domain instances of this process that talk over sockets, as two processes would.
struct WirePair {
  DomainConfig a;
  DomainConfig b;
};

inline WirePair fresh_wire_pair() {
  WirePair pair{fresh_domain(), {}};
  const std::string external = fmt::format("<Discovery><ExternalDomainId>{}</ExternalDomainId>", pair.a.domain_id);
  pair.a.xml.replace(pair.a.xml.find("<Discovery>"), std::string("<Discovery>").size(), external);
  pair.b = {pair.a.domain_id % 100 + 1, pair.a.xml};
  return pair;
}

}  // namespace trivela::bus
