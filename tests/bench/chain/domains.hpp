#pragma once

#include <fmt/core.h>
#include <unistd.h>

#include "bus/domain/domain.hpp"

namespace trivela::bench {

/// A domain for each contender of this process; the tag keeps out other runs.
inline bus::DomainConfig own_domain(int index) {
  return bus::loopback(static_cast<std::uint32_t>((getpid() + index) % 100 + 1),
                       fmt::format("chain-{}-{}", getpid(), index));
}

}  // namespace trivela::bench
