#include "log/file/stoppable.hpp"

#include <sqlite3.h>

#include <exception>

namespace trivela::log {
namespace {

constexpr int kStepsACall = 20'000;  // of SQLite's machine: under a millisecond

/// While it lives, statements of the connection end where `go_on` says no.
class Asking {
 public:
  Asking(sqlite3* handle, const std::function<bool()>& go_on) : handle_(handle), go_on_(go_on) {
    sqlite3_progress_handler(handle_, kStepsACall, ask, this);
  }
  Asking(const Asking&) = delete;
  Asking& operator=(const Asking&) = delete;
  ~Asking() { sqlite3_progress_handler(handle_, 0, nullptr, nullptr); }

  bool stopped() const { return stopped_; }
  std::exception_ptr failure() const { return failure_; }

 private:
  static int ask(void* asking) {
    auto& self = *static_cast<Asking*>(asking);
    try {
      self.stopped_ = self.stopped_ || !self.go_on_();
    } catch (...) {  // SQLite, which called, knows no exceptions
      self.stopped_ = true;
      self.failure_ = std::current_exception();
    }
    return self.stopped_ ? 1 : 0;
  }

  sqlite3* handle_;
  const std::function<bool()>& go_on_;
  bool stopped_ = false;
  std::exception_ptr failure_;
};

}  // namespace

void stoppable(SQLite::Database& database, const std::function<bool()>& go_on, const std::function<void()>& work) {
  const Asking asking(database.getHandle(), go_on);
  try {
    work();
  } catch (...) {
    if (asking.failure()) std::rethrow_exception(asking.failure());
    if (asking.stopped()) throw Stopped{};
    throw;
  }
}

}  // namespace trivela::log
