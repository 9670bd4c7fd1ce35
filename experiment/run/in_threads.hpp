#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <vector>

namespace trivela::experiment {

/// Nobody asks how far it is.
inline constexpr auto kNoProgress = [](std::size_t, std::size_t) {};

/// Calls `work(i)` for i = 0 to count - 1 from `jobs` threads, this one among them; `progress(done, count)` after each,
/// from one thread at a time. Where one of them throws nothing more is begun; the first exception is rethrown once all
/// have ended. Throws std::runtime_error where so many threads cannot be started.
template <class Work, class Progress = decltype(kNoProgress)>
void in_threads(std::size_t count, std::size_t jobs, const Work& work, const Progress& progress = kNoProgress) {
  std::atomic<std::size_t> next{0};
  std::size_t done = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  const auto thread = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i);
        const std::lock_guard lock{mutex};
        progress(++done, count);
      } catch (...) {
        const std::lock_guard lock{mutex};
        if (!failure) failure = std::current_exception();
        next = count;
      }
    }
  };
  {
    std::vector<std::jthread> threads;
    try {
      for (std::size_t i = 1; i < std::min(jobs, count); ++i) threads.emplace_back(thread);
    } catch (const std::system_error& error) {
      const std::lock_guard lock{mutex};
      next = count;
      failure = std::make_exception_ptr(std::runtime_error{fmt::format(
          "{} of {} threads can be started: {}; choose fewer jobs", threads.size() + 1, jobs, error.code().message())});
    }
    thread();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace trivela::experiment
