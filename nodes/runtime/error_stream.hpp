#pragma once

#include <fmt/format.h>
#include <poll.h>
#include <spdlog/sinks/base_sink.h>
#include <unistd.h>

#include <cstddef>
#include <mutex>
#include <string_view>

namespace trivela::nodes {

/// Writes to a descriptor that takes it within `timeout_ms`; false: it did not. What a full pipe or a stopped terminal
/// (Ctrl-S) has room for is at least a line.
inline bool write_line(int descriptor, std::string_view line, int timeout_ms) {
  pollfd out{descriptor, POLLOUT, 0};
  if (poll(&out, 1, timeout_ms) <= 0 || (out.revents & POLLOUT) == 0) return false;
  [[maybe_unused]] const auto written = write(descriptor, line.data(), line.size());  // nobody to tell of an error
  return true;
}

/// Log lines to standard error. It never waits for whoever reads them, since the thread that logs has a robot to serve:
/// a line without room is left out, and the number of such lines follows when there is room again.
class ErrorStream final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  explicit ErrorStream(int descriptor = STDERR_FILENO) : descriptor_(descriptor) {}

 private:
  void sink_it_(const spdlog::details::log_msg& message) override {
    spdlog::memory_buf_t line;
    formatter_->format(message, line);
    if (left_out_ > 0 && write_line(descriptor_, fmt::format("{} lines left out: nobody read them\n", left_out_), 0))
      left_out_ = 0;
    if (left_out_ > 0 || !write_line(descriptor_, {line.data(), line.size()}, 0)) ++left_out_;
  }
  void flush_() override {}

  int descriptor_;
  std::size_t left_out_ = 0;
};

}  // namespace trivela::nodes
