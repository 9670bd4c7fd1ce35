#include "tests/bench/chain/hogs.hpp"

#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <thread>

#include "tests/bench/chain/contender.hpp"

namespace trivela::bench {

Hogs::Hogs() {
  for (unsigned core = 0; core < std::max(4U, std::thread::hardware_concurrency()); ++core) {
    children_.push_back(fork_child([] {
      for (volatile unsigned turns = 0;;) turns = turns + 1;
    }));
  }
}

Hogs::~Hogs() {
  for (const pid_t child : children_) kill(child, SIGTERM);
  for (const pid_t child : children_) waitpid(child, nullptr, 0);
}

}  // namespace trivela::bench
