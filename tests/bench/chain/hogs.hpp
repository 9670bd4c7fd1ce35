#pragma once

#include <sys/types.h>

#include <vector>

namespace trivela::bench {

/// While it lives, a process per core that does nothing but use it.
class Hogs {
 public:
  Hogs();
  Hogs(const Hogs&) = delete;
  Hogs& operator=(const Hogs&) = delete;
  ~Hogs();

 private:
  std::vector<pid_t> children_;
};

}  // namespace trivela::bench
