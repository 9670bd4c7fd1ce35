#pragma once

#include <cstddef>
#include <string>
#include <vector>

/// What a thread asks of the heap and which mutexes it has to wait for, seen from outside: this program's own malloc()
/// and pthread_mutex_lock() stand before the C library's, for every library that it has loaded.
namespace trivela::tests {

/// Who (file name of the program or library) asked how often.
struct Asked {
  std::string object;
  std::size_t times = 0;
};

/// Of the calling thread, between start() and stop().
class PathHooks {
 public:
  static void start();
  static void stop();
  static std::vector<Asked> allocations();
  static std::vector<Asked> mutex_waits();
  /// Forgets what was counted.
  static void clear();
};

}  // namespace trivela::tests
