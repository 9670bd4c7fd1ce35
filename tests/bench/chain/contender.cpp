#include "tests/bench/chain/contender.hpp"

#include <fmt/core.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <stdexcept>

#include "bus/domain/process.hpp"

namespace trivela::bench {

pid_t fork_child(const std::function<void()>& body) {
  std::fflush(nullptr);
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("fork failed");
  if (child > 0) return child;
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(1);
  try {
    body();
  } catch (const std::exception& error) {
    fmt::print(stderr, "chain_bench: {}\n", error.what());
    _exit(1);
  }
  _exit(0);
}

Contender::Contender(std::string name, std::vector<Process> processes, int priority, std::string reference)
    : name_(std::move(name)), reference_(std::move(reference)) {
  for (const Process& process : processes) {
    children_.push_back(fork_child([&] {
      if (priority > 0) bus::set_realtime(priority);
      process(track_);
    }));
  }
}

Contender::~Contender() {
  for (const pid_t child : children_) kill(child, SIGTERM);
  for (const pid_t child : children_) waitpid(child, nullptr, 0);
}

void Contender::warm_up() {
  constexpr std::int64_t kSamples = 20, kPeriodNs = 1'000'000, kTimeoutNs = 120'000'000'000;
  const std::int64_t start_ns = now_ns();
  while (track_.run_batch(kSamples, kPeriodNs).size() < kSamples)
    if (now_ns() - start_ns > kTimeoutNs) throw std::runtime_error(name_ + ": the chain never came together");
}

}  // namespace trivela::bench
