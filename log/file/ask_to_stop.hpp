#pragma once

#include <functional>

namespace trivela::log {

/// While it lives, every statement of this thread on a LogFile asks `stop` about each millisecond of its work, and ends
/// where `stop` says so: the statement throws as one that asks for too much. One at a time in a thread.
class AskToStop {
 public:
  explicit AskToStop(std::function<bool()> stop);
  ~AskToStop();
  AskToStop(const AskToStop&) = delete;
  AskToStop& operator=(const AskToStop&) = delete;

  /// What the one that lives in this thread says; false: there is none.
  static bool says_stop();

 private:
  std::function<bool()> stop_;
};

}  // namespace trivela::log
