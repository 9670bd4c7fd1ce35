#include "bus/scheduling.hpp"

#include <fcntl.h>
#include <sched.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>

namespace trivela::bus {
namespace {

/// The kernel keeps to the latency for as long as the file is open: until this process ends.
bool keep_processors_awake() {
  static const int file = open("/dev/cpu_dma_latency", O_WRONLY | O_CLOEXEC);
  const std::int32_t longest_wake_up_us = 0;
  return file >= 0 && write(file, &longest_wake_up_us, sizeof longest_wake_up_us) == sizeof longest_wake_up_us;
}

}  // namespace

Realtime set_realtime(int priority) {
  const sched_param parameters{priority};
  return {.scheduled = sched_setscheduler(0, SCHED_FIFO, &parameters) == 0,
          .memory_locked = mlockall(MCL_CURRENT | MCL_FUTURE) == 0,
          .processors_awake = keep_processors_awake()};
}

}  // namespace trivela::bus
