#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "hal/board/kicker_board.hpp"
#include "hal/board/shot_queue.hpp"
#include "hal/kicker.hpp"
#include "hal/line/descriptor.hpp"

namespace trivela::hal {

/// A kicker whose board is at the end of a line. A thread of its own, with the priority of whoever makes it, speaks to
/// the board and holds each shot back until its instant; then it makes the one write, or none: a shot whose instant
/// comes while the board does not answer is dropped, and so is one that this process let wait for longer than
/// `latest`. What was dropped stands in status(). read() gives the newest sample.
class BoardKicker final : public Kicker {
 public:
  static constexpr std::chrono::nanoseconds kLatest = std::chrono::milliseconds(100);

  /// Starts the thread. Throws std::system_error where the system has none.
  explicit BoardKicker(std::unique_ptr<KickerBoard> board, std::chrono::nanoseconds latest = kLatest);
  ~BoardKicker() override;
  BoardKicker(const BoardKicker&) = delete;
  BoardKicker& operator=(const BoardKicker&) = delete;

  bool connected(std::chrono::nanoseconds timeout) override;
  std::optional<KickerSample> read(std::chrono::nanoseconds timeout) override;
  void fire(std::int64_t kick_id, double power, std::int64_t t_ns) override;
  void withdraw(std::int64_t kick_id) override;
  void make_safe() noexcept override;
  bool ended() const override { return false; }
  KickerCapabilities capabilities() const override { return capabilities_; }
  std::string status() const override;

 private:
  void run();
  bool fire_due();
  std::string send(const Shot& shot, std::int64_t now_ns);
  std::int64_t next_shot_ns() const;
  void publish();
  void wait() const;
  void wake() const noexcept;

  const std::unique_ptr<KickerBoard> board_;  // the thread's
  const std::chrono::nanoseconds latest_;
  const KickerCapabilities capabilities_;
  const Descriptor wake_;

  mutable std::mutex mutex_;  // of all that follows
  std::condition_variable changed_;
  ShotQueue shots_;
  std::optional<KickerSample> sample_;  // not yet read
  std::string status_;
  std::string dropped_;
  bool up_ = false;
  bool safe_ = false;
  bool stopping_ = false;

  std::thread thread_;
};

}  // namespace trivela::hal
