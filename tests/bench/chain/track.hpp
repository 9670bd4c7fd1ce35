#pragma once

#include <semaphore.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

namespace trivela::bench {

/// CLOCK_MONOTONIC, the same in all processes.
std::int64_t now_ns();

/// What the processes of one chain share with the parent, which makes it before they exist. The parent orders a batch
/// of samples from the chain's source; its sink says how long each took.
class Track {
 public:
  static constexpr std::int64_t kMostPerBatch = 4096;

  Track();
  Track(const Track&) = delete;
  Track& operator=(const Track&) = delete;
  ~Track();

  /// Parent: has the source send `count` samples and waits until the sink has seen them all, or none came for half a
  /// second. Returns the latencies of those that arrived.
  std::vector<std::int64_t> run_batch(std::int64_t count, std::int64_t period_ns);

  /// Source: the next batch ordered within the timeout, if any.
  struct Batch {
    std::int64_t first_seq;
    std::int64_t count;
    std::int64_t period_ns;
  };
  std::optional<Batch> next_batch(std::chrono::nanoseconds timeout);
  void batch_sent();

  /// Sink: a sample that was stamped at t_ns has arrived now.
  void arrived(std::int64_t seq, std::int64_t t_ns);

 private:
  struct Shared {
    sem_t ordered, sent, seen;
    Batch batch;
    std::int64_t latency_ns[kMostPerBatch];
  };
  Shared* shared_;
  std::int64_t next_seq_ = 1;
};

}  // namespace trivela::bench
