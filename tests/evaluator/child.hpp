#pragma once

#include <sys/types.h>
#include <unistd.h>

#include <cstdint>
#include <functional>
#include <stdexcept>

namespace trivela::evaluator {

/// Runs `work` in a child, which reports numbers through the function that it gets.
struct Child {
  explicit Child(const std::function<void(const std::function<void(std::int64_t)>&)>& work) {
    int ends[2];
    if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
    id = ::fork();
    if (id == 0) {
      ::close(ends[0]);
      work([&](std::int64_t number) { (void)!::write(ends[1], &number, sizeof(number)); });
      ::_exit(0);
    }
    ::close(ends[1]);
    read_end = ends[0];
  }
  ~Child() { ::close(read_end); }

  std::int64_t next() const {
    std::int64_t number = -1;
    return ::read(read_end, &number, sizeof(number)) == sizeof(number) ? number : -1;
  }

  pid_t id = 0;
  int read_end = -1;
};

}  // namespace trivela::evaluator
