#include "tests/nodes/path_hooks.hpp"

#include <dlfcn.h>
#include <pthread.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <filesystem>
#include <map>

extern "C" {
void* __libc_malloc(std::size_t);                 // NOLINT(bugprone-reserved-identifier,readability-identifier-naming)
void* __libc_calloc(std::size_t, std::size_t);    // NOLINT(bugprone-reserved-identifier,readability-identifier-naming)
void* __libc_realloc(void*, std::size_t);         // NOLINT(bugprone-reserved-identifier,readability-identifier-naming)
void* __libc_memalign(std::size_t, std::size_t);  // NOLINT(bugprone-reserved-identifier,readability-identifier-naming)
}

namespace {

// The names are looked up afterwards: who looks up inside malloc() may be asked to lock and to allocate.
struct Callers {
  std::array<void*, 65536> at{};
  std::atomic<std::size_t> count = 0;  // another thread may look

  void add(void* caller) {
    const std::size_t i = count;
    if (i < at.size()) at[i] = caller;
    count = i + 1;
  }
};

thread_local bool counting = false;
Callers allocating, waiting;  // of the one thread that counts

void note(Callers& callers, void* caller) {
  if (counting) callers.add(caller);
}

using Lock = int (*)(pthread_mutex_t*);
Lock real_lock() {
  static const Lock lock = reinterpret_cast<Lock>(dlsym(RTLD_NEXT, "pthread_mutex_lock"));
  return lock;
}

std::vector<trivela::tests::Asked> by_object(const Callers& callers) {
  std::map<std::string, std::size_t> times;
  for (std::size_t i = 0; i < std::min(callers.count.load(), callers.at.size()); ++i) {
    Dl_info info{};
    const bool known = dladdr(callers.at[i], &info) != 0 && info.dli_fname != nullptr;
    ++times[known ? std::filesystem::path(info.dli_fname).filename().string() : "?"];
  }
  std::vector<trivela::tests::Asked> out;
  for (const auto& [object, n] : times) out.push_back({object, n});
  return out;
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) {
  note(allocating, __builtin_return_address(0));
  return __libc_malloc(size);
}
void* calloc(std::size_t n, std::size_t size) {
  note(allocating, __builtin_return_address(0));
  return __libc_calloc(n, size);
}
void* realloc(void* memory, std::size_t size) {
  note(allocating, __builtin_return_address(0));
  return __libc_realloc(memory, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  note(allocating, __builtin_return_address(0));
  return __libc_memalign(alignment, size);
}

int pthread_mutex_lock(pthread_mutex_t* mutex) {
  const int got = pthread_mutex_trylock(mutex);
  if (got != EBUSY) return got;
  note(waiting, __builtin_return_address(0));
  return real_lock()(mutex);
}

}  // extern "C"

namespace trivela::tests {

void PathHooks::start() { counting = true; }
void PathHooks::stop() { counting = false; }
std::vector<Asked> PathHooks::allocations() { return by_object(allocating); }
std::vector<Asked> PathHooks::mutex_waits() { return by_object(waiting); }
void PathHooks::clear() {
  allocating.count = 0;
  waiting.count = 0;
}

}  // namespace trivela::tests
