#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "hal/kicker.hpp"
#include "hal/wheels.hpp"

namespace trivela::nodes {

inline constexpr std::chrono::seconds kPlenty{20};

/// The far side of a device that a node owns: the test puts samples in and sees the commands that come out.
template <class Sample, class Command>
class FarSide {
 public:
  void put(const Sample& sample) {
    const std::lock_guard lock{mutex_};
    samples_.push_back(sample);
    changed_.notify_all();
  }

  /// The first n commands, fewer if they do not come.
  std::vector<Command> commands(std::size_t n) {
    std::unique_lock lock{mutex_};
    changed_.wait_for(lock, kPlenty, [&] { return commands_.size() >= n; });
    return {commands_.begin(), commands_.begin() + static_cast<std::ptrdiff_t>(std::min(n, commands_.size()))};
  }

  std::size_t commanded() const {
    const std::lock_guard lock{mutex_};
    return commands_.size();
  }
  std::size_t unread() const {
    const std::lock_guard lock{mutex_};
    return samples_.size();
  }

  std::optional<Sample> next(std::chrono::nanoseconds timeout) {
    std::unique_lock lock{mutex_};
    reader_ = std::this_thread::get_id();
    changed_.wait_for(lock, timeout, [&] { return !samples_.empty(); });
    if (samples_.empty()) return std::nullopt;
    const Sample sample = samples_.front();
    samples_.pop_front();
    return sample;
  }
  void command(const Command& command) {
    const std::lock_guard lock{mutex_};
    commands_.push_back(command);
    changed_.notify_all();
  }

  /// The thread that reads the samples.
  std::thread::id reader() const {
    const std::lock_guard lock{mutex_};
    return reader_;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Sample> samples_;
  std::vector<Command> commands_;
  std::thread::id reader_;
};

struct Driven {
  kicking::Twist twist;
  std::int64_t t_ns;
  std::thread::id thread;
};

struct Fired {
  std::int64_t kick_id;
  double power;
  std::int64_t t_ns;
  std::int64_t until_ns;
  std::thread::id thread;
};

using WheelsFarSide = FarSide<hal::WheelSample, Driven>;

struct KickerFarSide : FarSide<hal::KickerSample, Fired> {
  std::atomic<bool> safe = false;
  std::atomic<std::int64_t> withdrawn = 0;  ///< kick_id that was called off last
  std::atomic<hal::KickerCapabilities> can{};
  std::atomic<hal::ChargeCommand> told = hal::ChargeCommand::kHold;  ///< the capacitor, last

  std::atomic<double> most_power = 1e9;

  void hold_when(const hal::Kicker::Hold& hold) {
    const std::lock_guard lock{link_mutex_};
    hold_ = hold;
  }
  void call_when_written(const std::function<void()>& written) {
    const std::lock_guard lock{link_mutex_};
    written_ = written;
  }
  void was_written() const {
    const std::lock_guard lock{link_mutex_};
    if (written_) written_();
  }
  /// Whether a shot that was judged then is held.
  bool holds(std::int64_t judged_ns) const {
    const std::lock_guard lock{link_mutex_};
    return hold_ && hold_(judged_ns);
  }

  /// What becomes of a shot.
  void say_result(const hal::ShotResult& result) {
    const std::lock_guard lock{link_mutex_};
    result_ = result;
  }
  std::optional<hal::ShotResult> take_result() {
    const std::lock_guard lock{link_mutex_};
    return std::exchange(result_, std::nullopt);
  }

  /// What the device says of its link.
  void say_link(const std::string& link) {
    const std::lock_guard lock{link_mutex_};
    link_ = link;
  }
  std::string link() const {
    const std::lock_guard lock{link_mutex_};
    return link_;
  }

 private:
  mutable std::mutex link_mutex_;
  std::string link_;
  std::optional<hal::ShotResult> result_;
  hal::Kicker::Hold hold_;
  std::function<void()> written_;
};

class FakeWheels : public hal::Wheels {
 public:
  explicit FakeWheels(std::shared_ptr<WheelsFarSide> far_side) : far_side_(std::move(far_side)) {}
  bool connected(std::chrono::nanoseconds) override { return true; }
  std::optional<hal::WheelSample> read(std::chrono::nanoseconds timeout) override { return far_side_->next(timeout); }
  void drive(const kicking::Twist& set_point, std::int64_t t_ns) override {
    far_side_->command({set_point, t_ns, std::this_thread::get_id()});
  }

 private:
  std::shared_ptr<WheelsFarSide> far_side_;
};

class FakeKicker : public hal::Kicker {
 public:
  explicit FakeKicker(std::shared_ptr<KickerFarSide> far_side) : far_side_(std::move(far_side)) {}
  ~FakeKicker() override { far_side_->safe = true; }
  bool connected(std::chrono::nanoseconds) override { return true; }
  std::optional<hal::KickerSample> read(std::chrono::nanoseconds timeout) override { return far_side_->next(timeout); }
  void fire(const hal::Shot& shot) override {
    if (far_side_->safe || far_side_->holds(shot.judged_ns)) return;
    far_side_->command({shot.kick_id, shot.power, shot.t_ns, shot.until_ns, std::this_thread::get_id()});
    far_side_->was_written();
  }
  void withdraw(std::int64_t kick_id) override { far_side_->withdrawn = kick_id; }
  void hold_when(const Hold& hold) override { far_side_->hold_when(hold); }
  void call_when_written(const std::function<void()>& written) override { far_side_->call_when_written(written); }
  std::optional<hal::ShotResult> take_result() override { return far_side_->take_result(); }
  std::string beyond(double power) const override {
    return power > far_side_->most_power ? "it has no such pulse" : std::string{};
  }
  void make_safe() noexcept override { far_side_->safe = true; }
  void charge(hal::ChargeCommand word) override { far_side_->told = word; }
  hal::KickerCapabilities capabilities() const override { return far_side_->can; }
  std::string status() const override { return far_side_->link(); }

 private:
  std::shared_ptr<KickerFarSide> far_side_;
};

}  // namespace trivela::nodes
