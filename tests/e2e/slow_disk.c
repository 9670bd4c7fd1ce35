// Preloaded, it makes each synchronisation of a file take SLOW_DISK_MS milliseconds longer, as a slow disk would.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <poll.h>
#include <stdlib.h>

static void wait_for_the_disk(void) {
  const char* const ms = getenv("SLOW_DISK_MS");
  if (ms != NULL) poll(NULL, 0, atoi(ms));
}

int fsync(int descriptor) {
  int (*const real)(int) = (int (*)(int))dlsym(RTLD_NEXT, "fsync");
  wait_for_the_disk();
  return real(descriptor);
}

int fdatasync(int descriptor) {
  int (*const real)(int) = (int (*)(int))dlsym(RTLD_NEXT, "fdatasync");
  wait_for_the_disk();
  return real(descriptor);
}
