#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace trivela::cli {

/// Calls `work(i)` for each i below `all` by `jobs` threads, this one among them, in the order of i as far as they are
/// free. `progress(done, all)` is called from one thread at a time. Where one of them throws, nothing more is begun,
/// and it is rethrown.
void share_out(std::size_t all, unsigned jobs, const auto& work, const auto& progress) {
  std::atomic<std::size_t> next = 0;
  std::size_t done = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  const auto take = [&] {
    for (std::size_t i = next++; i < all; i = next++) {
      try {
        work(i);
        const std::lock_guard lock{mutex};
        progress(++done, all);
      } catch (...) {
        const std::lock_guard lock{mutex};
        if (!failure) failure = std::current_exception();
        next = all;
        return;
      }
    }
  };
  {
    std::vector<std::jthread> threads;
    for (unsigned i = 1; i < jobs; ++i) threads.emplace_back(take);
    take();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace trivela::cli
