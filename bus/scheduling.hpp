#pragma once

namespace trivela::bus {

/// Which of the two were permitted.
struct Realtime {
  bool scheduled = false;      // SCHED_FIFO for this thread and those it starts
  bool memory_locked = false;  // no page of this process leaves the memory
};

/// Asks for SCHED_FIFO at a priority (1..99) and locked memory. Call it before the first Participant: the bus's threads
/// inherit it. Under load it matters a hundred times more than the transport.
Realtime set_realtime(int priority);

}  // namespace trivela::bus
