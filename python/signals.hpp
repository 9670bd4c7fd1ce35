#pragma once

#include <chrono>
#include <exception>

#include "log/file/ask_to_stop.hpp"
#include "python/arrays.hpp"

namespace trivela::python {

/// Looks for Ctrl-C from a thread without the interpreter's lock, every 50 ms at most.
class Signals {
 public:
  /// Did a handler raise, now or before?
  bool raised() {
    const auto now = std::chrono::steady_clock::now();
    if (raised_ || now - looked_ < std::chrono::milliseconds(50)) return raised_ != nullptr;
    const py::gil_scoped_acquire python;
    looked_ = now;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    } catch (...) {
      raised_ = std::current_exception();
    }
    return raised_ != nullptr;
  }

  void raise_again() const {
    if (raised_) std::rethrow_exception(raised_);
  }

 private:
  std::exception_ptr raised_;
  std::chrono::steady_clock::time_point looked_ = std::chrono::steady_clock::now();
};

/// Does `work` on logs without the interpreter's lock. Ctrl-C ends it: what the handler raises is thrown.
template <class Work>
auto reading(Work work) {
  Signals signals;
  try {
    const py::gil_scoped_release others;
    const log::AskToStop stop([&] { return signals.raised(); });
    return work();
  } catch (...) {
    signals.raise_again();
    throw;
  }
}

}  // namespace trivela::python
