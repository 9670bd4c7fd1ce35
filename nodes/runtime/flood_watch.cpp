#include "nodes/runtime/flood_watch.hpp"

#include <fmt/core.h>
#include <malloc.h>
#include <pthread.h>
#include <unistd.h>

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <utility>

namespace trivela::nodes {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int kPollsBetween = 10;  // of what is looked at less often than memory
constexpr std::int64_t kMb = std::int64_t{1} << 20;
constexpr std::int64_t kGrown = 32 * kMb;  // a node starts with less

std::string first_word(const fs::path& file) {
  std::ifstream in{file};
  std::string word;
  in >> word;
  return word;
}

/// How often a thread waited for something of its own accord.
std::int64_t pauses_of(const fs::path& task) {
  std::ifstream in{task / "status"};
  std::int64_t pauses = 0;
  for (std::string word; in >> word;)
    if (word == "voluntary_ctxt_switches:") in >> pauses;
  return pauses;
}

}  // namespace

std::int64_t resident_bytes() {
  std::ifstream statm{"/proc/self/statm"};
  std::int64_t pages = 0, resident = 0;
  return statm >> pages >> resident ? resident * sysconf(_SC_PAGESIZE) : 0;
}

FloodWatch::FloodWatch(std::uint32_t limit_mb, bus::Stop& stop, Tell tell, std::chrono::milliseconds interval,
                       std::chrono::milliseconds grace)
    : limit_mb_(limit_mb), stop_(stop), tell_(std::move(tell)), interval_(interval), grace_(grace), thread_([this] {
        look();
      }) {
  pthread_setname_np(thread_.native_handle(), "flood_watch");
}

FloodWatch::~FloodWatch() {
  over_.request();
  thread_.join();
}

void FloodWatch::look() {
  for (auto next = Clock::now() + interval_; !over_.wait_until(next); next += interval_) {
    ++polls_;
    std::string why;
    try {
      why = fault();
    } catch (const std::exception&) {
      // /proc cannot be read now, or there is no memory: the next interval may see more.
    }
    if (!why.empty()) return end(why + ": ends, to be started again");
  }
}

void FloodWatch::end(const std::string& why) {
  ended_ = true;
  stop_.request();
  tell_(why);
  const auto force = Clock::now() + grace_;
  while (!over_.wait_until(Clock::now() + interval_))
    if (Clock::now() > force || resident_bytes() > 2 * kMb * limit_mb_) std::_Exit(1);
}

/// Empty: none.
std::string FloodWatch::fault() {
  const std::int64_t bytes = resident_bytes();
  if (bytes > limit_mb_ * kMb)
    return fmt::format("takes {} MB of memory, more than run.memory_limit_mb = {}", bytes / kMb, limit_mb_);
  if (polls_ % kPollsBetween != 0) return {};
  if (gives_back_ && bytes > start_bytes_ + kGrown) malloc_trim(0);
  if (handshakes_turn()) return "the thread of handshakes does not come round, nobody would be let in any more";
  return {};
}

/// Whether one ran since it was looked at last and did not once wait of its own accord. It may have had little of a
/// processor; one that sleeps has not run.
bool FloodWatch::handshakes_turn() {
  bool turns = false;
  const std::int64_t tenth_ns = std::chrono::nanoseconds{interval_ * kPollsBetween}.count() / 10;
  for (const auto& task : fs::directory_iterator{"/proc/self/task"}) {
    if (first_word(task.path() / "comm") != kHandshakes) continue;
    Turns now{pauses_of(task.path()), 0};
    std::ifstream{task.path() / "schedstat"} >> now.ran_ns;
    const Turns before = std::exchange(handshakes_[task.path().filename()], now);
    turns = turns || (before.ran_ns != 0 && now.pauses == before.pauses && now.ran_ns - before.ran_ns > tenth_ns);
  }
  return turns;
}

}  // namespace trivela::nodes
