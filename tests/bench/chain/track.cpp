#include "tests/bench/chain/track.hpp"

#include <sys/mman.h>
#include <time.h>

#include <algorithm>
#include <cerrno>
#include <new>
#include <stdexcept>

namespace trivela::bench {
namespace {

// Waits for a semaphore no longer than the timeout.
bool wait(sem_t& semaphore, std::chrono::nanoseconds timeout) {
  timespec until{};
  clock_gettime(CLOCK_MONOTONIC, &until);
  const std::int64_t total_ns = until.tv_nsec + timeout.count();
  until.tv_sec += total_ns / 1'000'000'000;
  until.tv_nsec = total_ns % 1'000'000'000;
  while (sem_clockwait(&semaphore, CLOCK_MONOTONIC, &until) != 0)
    if (errno != EINTR) return false;
  return true;
}

}  // namespace

std::int64_t now_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1'000'000'000 + now.tv_nsec;
}

Track::Track() {
  void* memory = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::runtime_error("no shared memory for a track");
  shared_ = new (memory) Shared{};
  for (sem_t* semaphore : {&shared_->ordered, &shared_->sent, &shared_->seen}) sem_init(semaphore, 1, 0);
}

Track::~Track() { munmap(shared_, sizeof(Shared)); }

std::vector<std::int64_t> Track::run_batch(std::int64_t count, std::int64_t period_ns) {
  constexpr std::chrono::milliseconds kTimeout{500};
  while (wait(shared_->seen, std::chrono::nanoseconds(0))) continue;  // stragglers of the last batch
  std::fill_n(shared_->latency_ns, count, -1);
  shared_->batch = {next_seq_, count, period_ns};
  next_seq_ += count;
  sem_post(&shared_->ordered);
  std::vector<std::int64_t> latencies;
  if (!wait(shared_->sent, std::chrono::nanoseconds(count * period_ns) + std::chrono::seconds(5))) return latencies;
  for (std::int64_t n = 0; n < count && wait(shared_->seen, kTimeout); ++n) continue;
  std::copy_if(shared_->latency_ns, shared_->latency_ns + count, std::back_inserter(latencies),
               [](std::int64_t latency_ns) { return latency_ns >= 0; });
  return latencies;
}

std::optional<Track::Batch> Track::next_batch(std::chrono::nanoseconds timeout) {
  if (!wait(shared_->ordered, timeout)) return std::nullopt;
  return shared_->batch;
}

void Track::batch_sent() { sem_post(&shared_->sent); }

void Track::arrived(std::int64_t seq, std::int64_t t_ns) {
  const std::int64_t latency_ns = now_ns() - t_ns;
  const std::int64_t index = seq - shared_->batch.first_seq;
  if (index < 0 || index >= shared_->batch.count) return;  // of an earlier batch
  shared_->latency_ns[index] = latency_ns;
  sem_post(&shared_->seen);
}

}  // namespace trivela::bench
