#pragma once

#include <fmt/format.h>
#include <poll.h>
#include <spdlog/sinks/base_sink.h>
#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <string>
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

/// Passes a few lines of a kind on in each second; of the rest it says how many there were. Lines are of one kind if
/// they begin alike but for their digits.
class LimitedSink : public spdlog::sinks::base_sink<std::mutex> {
 public:
  static constexpr std::size_t kLinesPerSecond = 3;  ///< of one kind
  static constexpr std::size_t kMostKinds = 32;      ///< all further ones are one kind
  static constexpr std::size_t kLongest = 300;       ///< characters; what is longer is cut

  explicit LimitedSink(std::shared_ptr<spdlog::sinks::sink> out) : out_(std::move(out)) {}
  ~LimitedSink() override { tell_all(); }

 private:
  using Time = spdlog::log_clock::time_point;
  struct Kind {
    Time second;  // that is counted
    std::size_t lines = 0;
    spdlog::level::level_enum level = spdlog::level::info;
    std::string logger;
    std::string last;
  };

  void sink_it_(const spdlog::details::log_msg& message) override;
  void flush_() override { out_->flush(); }
  void set_pattern_(const std::string& pattern) override { out_->set_pattern(pattern); }
  void set_formatter_(std::unique_ptr<spdlog::formatter> formatter) override {
    out_->set_formatter(std::move(formatter));
  }
  void tell(const Kind& kind, Time now);
  void tell_all();

  std::shared_ptr<spdlog::sinks::sink> out_;
  std::map<std::string, Kind> kinds_;
};

}  // namespace trivela::nodes
