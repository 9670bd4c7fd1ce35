#include "bus/scheduling.hpp"

#include <sched.h>
#include <sys/mman.h>

namespace trivela::bus {

Realtime set_realtime(int priority) {
  const sched_param parameters{priority};
  return {.scheduled = sched_setscheduler(0, SCHED_FIFO, &parameters) == 0,
          .memory_locked = mlockall(MCL_CURRENT | MCL_FUTURE) == 0};
}

}  // namespace trivela::bus
