#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "hal/board/kicker_board.hpp"
#include "hal/kicker.hpp"
#include "hal/line/descriptor.hpp"

namespace trivela::hal {

/// Shots that wait for their instants, all of the steady clock. One thread at a time.
class ShotQueue {
 public:
  static constexpr std::int64_t kNever_ns = std::numeric_limits<std::int64_t>::max();

  void add(const Shot& shot);

  /// Drops the shot `kick_id`, also where its instant has come and nobody has taken it.
  void withdraw(std::int64_t kick_id);

  /// Takes the earliest shot whose instant has come.
  std::optional<Shot> take_due(std::int64_t now_ns);

  /// The instant of the earliest; kNever_ns: there is none.
  std::int64_t next_ns() const { return shots_.empty() ? kNever_ns : shots_.front().t_ns; }

  void clear() noexcept { shots_.clear(); }

 private:
  std::vector<Shot> shots_;  // by instant, then as they were ordered
};

/// A kicker whose board is at the end of a line. A thread of its own, with the priority of whoever makes it, speaks to
/// the board and holds each shot back until its instant; then it makes the one write, or none. It drops a shot:
/// - whose instant comes while the board does not answer,
/// - whose deadline is over when it looks at the clock, immediately before the write,
/// - for whose kind of kick the lever does not stand,
/// - that hold_when() holds.
/// What was dropped stands in status() and in take_result(). read() gives the newest sample.
class BoardKicker final : public Kicker {
 public:
  /// Starts the thread. Throws std::system_error where the system has none.
  explicit BoardKicker(std::unique_ptr<KickerBoard> board);
  ~BoardKicker() override;
  BoardKicker(const BoardKicker&) = delete;
  BoardKicker& operator=(const BoardKicker&) = delete;

  bool connected(std::chrono::nanoseconds timeout) override;
  std::optional<KickerSample> read(std::chrono::nanoseconds timeout) override;
  void fire(const Shot& shot) override;
  void withdraw(std::int64_t kick_id) override;
  void hold_when(const Hold& hold) override;
  void call_when_written(const std::function<void()>& written) override;
  std::optional<ShotResult> take_result() override;
  std::string beyond(double power) const override { return board_->beyond(power); }
  void lever(std::uint8_t kick_kind) override { lever_kind_ = kick_kind; }
  void make_safe() noexcept override;
  KickerCapabilities capabilities() const override { return capabilities_; }
  std::string status() const override;

 private:
  void run();
  bool fire_due();
  void send(const Shot& shot);
  void drop(const Shot& shot, ShotResult::What what, const std::string& why);
  std::int64_t next_shot_ns() const;
  void publish();
  void wait() const;
  void wake() const noexcept;

  const std::unique_ptr<KickerBoard> board_;  // the thread's
  const KickerCapabilities capabilities_;
  const Descriptor wake_;
  std::atomic<std::uint8_t> lever_kind_ = 0;

  mutable std::mutex mutex_;  // of all that follows
  std::condition_variable changed_;
  ShotQueue shots_;
  Hold hold_;
  std::function<void()> written_;
  std::optional<KickerSample> sample_;  // not yet read
  std::string status_;
  std::string dropped_;  // what status() says of the last shot
  std::vector<ShotResult> results_;
  bool up_ = false;
  bool safe_ = false;
  bool stopping_ = false;

  std::thread thread_;
};

}  // namespace trivela::hal
