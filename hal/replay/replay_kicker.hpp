#pragma once

#include <atomic>
#include <vector>

#include "hal/kicker.hpp"
#include "hal/replay/row_pages.hpp"
#include "idl/kick.hpp"

namespace trivela::hal {

/// The kicker samples of a match log (table kicker_status), as fast as they are read. Nothing is energised. `armed` is
/// as recorded, which is the arm switch while the game was on.
class ReplayKicker final : public Kicker {
 public:
  explicit ReplayKicker(const ReplayLog& log) : samples_(log) {}

  bool connected(std::chrono::nanoseconds) override { return true; }

  /// Never waits.
  std::optional<KickerSample> read(std::chrono::nanoseconds timeout) override;
  void fire(const Shot& shot) override;
  void withdraw(std::int64_t kick_id) override;
  void make_safe() noexcept override { safe_ = true; }
  bool ended() const override { return samples_.peek() == nullptr; }

  struct Fire {
    std::int64_t t_ns;
    std::int64_t kick_id;
    double power;
  };
  /// What would have been energised so far. For the thread that calls fire().
  const std::vector<Fire>& fires() const { return fires_; }

 private:
  RowPages<msg::KickerStatus> samples_;
  std::vector<Fire> fires_;
  std::atomic<bool> safe_ = false;
  std::atomic<std::int64_t> now_t_ns_ = 0;  // of the last sample
};

}  // namespace trivela::hal
