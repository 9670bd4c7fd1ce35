#pragma once

#include <fmt/core.h>

#include <chrono>
#include <cstdio>

namespace trivela::nodes {

/// "played_s total_s" lines on standard output, about five a second, for whoever shows progress; behind the last one
/// stands "end": all was played.
class ProgressLine {
 public:
  void say(double played_s, double total_s, bool last) {
    const auto now = std::chrono::steady_clock::now();
    if (!last && now - said_ < std::chrono::milliseconds(200)) return;
    said_ = now;
    fmt::print("{:.2f} {:.2f}{}\n", played_s, total_s, last ? " end" : "");
    std::fflush(stdout);
  }

 private:
  std::chrono::steady_clock::time_point said_{};
};

}  // namespace trivela::nodes
