#pragma once

#include <cstddef>
#include <set>
#include <string_view>
#include <vector>

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

/// Which of the three were permitted.
struct Realtime {
  bool scheduled = false;         ///< SCHED_FIFO for this thread and those it starts
  bool memory_locked = false;     ///< no page of this process leaves the memory
  bool processors_awake = false;  ///< no processor sleeps while this process lives (/dev/cpu_dma_latency = 0)
};

/// Asks for SCHED_FIFO at a priority (1..99), locked memory and processors that stay awake. Call it before the first
/// Participant: the bus's threads inherit it. Under load scheduling matters a hundred times more than the transport;
/// when idle the wake-up of a sleeping processor takes longer than the whole chain.
Realtime set_realtime(int priority);

/// The processors that this process may use, ascending.
std::vector<int> processors_allowed();

/// Keeps this thread and those that it starts on one processor. Call it before the first Participant, as
/// set_realtime(). Throws Error naming those that there are where it is none of them.
void stay_on(int processor);

/// Whether Cyclone's configuration names the loopback interface and no other.
bool loopback_alone(std::string_view xml);

/// File descriptors of this process's UDP sockets on a port of DDS (domains 0 to 100) that hear every interface.
std::set<int> open_to_all();

/// From now on the socket hears the loopback interface alone, whatever address it is bound to (SO_BINDTODEVICE, which
/// takes no right since Linux 5.7). Throws Error where the kernel refuses.
void receive_loopback_only(int socket);

}  // namespace trivela::bus
