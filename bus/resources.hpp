#pragma once

#include <cstddef>

namespace trivela::bus {

/// A participant on loopback opens three sockets and a pipe; several interfaces, and the log and devices of its node,
/// take more.
inline constexpr std::size_t kDescriptors = 16;
/// A participant on loopback starts six; its node has up to three of its own.
inline constexpr std::size_t kThreads = 10;

/// Throws Error naming the limit where this process could not open kDescriptors more file descriptors or start kThreads
/// more threads: Cyclone 0.10 crashes where it runs out of either. Looks until it once has not
/// thrown.
void require_resources();

}  // namespace trivela::bus
