#pragma once

#include <sys/types.h>

#include <vector>

namespace trivela::bench {

/// While it lives, four processes, or one per core where there are more, that do nothing but use them.
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
