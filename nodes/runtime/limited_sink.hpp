#pragma once

#include <spdlog/sinks/base_sink.h>

#include <chrono>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace trivela::nodes {

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
