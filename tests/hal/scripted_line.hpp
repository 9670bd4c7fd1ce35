#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "hal/line/line.hpp"

namespace trivela::tests {

/// A line whose other end is the test: what was written, and what is there to be read.
struct ScriptedEnd {
  bool plugged = true;
  bool takes_bytes = true;
  std::string incoming;                ///< to be read
  std::vector<std::string> written{};  ///< each write
  int dropped = 0;                     ///< how often what had not left was dropped
  int opened = 0;
};

class ScriptedLine final : public hal::Line {
 public:
  explicit ScriptedLine(ScriptedEnd& end) : end_(end) {}

  Opening open(Deadline) override {
    open_ = end_.plugged;
    end_.opened += open_ ? 1 : 0;
    return open_ ? Opening::kOpen : Opening::kFailed;
  }
  std::optional<std::size_t> read(std::span<char> bytes, Deadline) override {
    if (!end_.plugged) return std::nullopt;
    const std::size_t count = std::min(bytes.size(), end_.incoming.size());
    std::copy_n(end_.incoming.begin(), count, bytes.begin());
    end_.incoming.erase(0, count);
    return count;
  }
  bool write(std::string_view bytes, Deadline) override {
    if (!end_.plugged || !end_.takes_bytes) return false;
    end_.written.emplace_back(bytes);
    return true;
  }
  void drop_unsent() noexcept override { ++end_.dropped; }
  void close() noexcept override { open_ = false; }
  int descriptor() const override { return -1; }
  const std::string& name() const override { return name_; }
  const std::string& why() const override { return why_; }

 private:
  ScriptedEnd& end_;
  bool open_ = false;
  std::string name_ = "/dev/ttyTEST";
  std::string why_ = "no such file or directory";
};

}  // namespace trivela::tests
