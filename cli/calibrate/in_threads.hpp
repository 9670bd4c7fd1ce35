#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace trivela::cli {

/// Calls `work(i)` for i = 0 to count - 1 from `jobs` threads; rethrows the first exception once all have ended.
template <class Work>
void in_threads(std::size_t count, std::size_t jobs, const Work& work) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  const auto thread = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        const std::lock_guard lock{mutex};
        if (!failure) failure = std::current_exception();
        next = count;
      }
    }
  };
  std::vector<std::thread> threads;
  for (std::size_t i = 1; i < std::min(jobs, count); ++i) threads.emplace_back(thread);
  thread();
  for (std::thread& one : threads) one.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace trivela::cli
