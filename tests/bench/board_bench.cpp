// How late a shot leaves: from the order, and from the instant that it was given, to the end of the write() of its
// bytes, on a pseudo-terminal with an emulated ioBoard behind it; beside the same write without the backend, in one
// run. With --driver the way is longer: from the order on the bus through a process trivela-kicker_driver until the
// emulated board has read the frame, beside a bare write that it reads.
//
//     board_bench [--shots N] [--realtime PRIORITY] [--load] [--driver] [--goals]
#include <CLI/CLI.hpp>

#include <fmt/core.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "emulators/ioboard/emulated_board.hpp"
#include "hal/board/board_kicker.hpp"
#include "hal/ioboard/io_board.hpp"
#include "tests/bench/board_driver.hpp"

namespace {

using namespace trivela::hal;

std::int64_t steady_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// A line that notes when the write of a shot was over.
class StampedLine final : public Line {
 public:
  StampedLine(const std::string& path, std::atomic<std::int64_t>& shot_ns)
      : line_(serial_line(path)), shot_ns_(shot_ns) {}

  Opening open(Deadline deadline) override { return line_->open(deadline); }
  std::optional<std::size_t> read(std::span<char> bytes, Deadline deadline) override {
    return line_->read(bytes, deadline);
  }
  bool write(std::string_view bytes, Deadline deadline) override {
    const bool written = line_->write(bytes, deadline);
    if (bytes.size() > 1 && bytes[1] == static_cast<char>(ioboard::Command::kShoot)) shot_ns_ = steady_ns();
    return written;
  }
  void drop_unsent() noexcept override { line_->drop_unsent(); }
  void close() noexcept override { line_->close(); }
  int descriptor() const override { return line_->descriptor(); }
  const std::string& name() const override { return line_->name(); }
  const std::string& why() const override { return line_->why(); }

 private:
  std::unique_ptr<Line> line_;
  std::atomic<std::int64_t>& shot_ns_;
};

/// What is measured of one kind of shot, and the goal at its 99th percentile.
struct Row {
  std::string what;
  std::vector<std::int64_t> spans_ns;
  double goal_us = 0.0;  ///< 0: none

  double at_us(double part) const {
    return static_cast<double>(spans_ns[static_cast<std::size_t>(part * static_cast<double>(spans_ns.size() - 1))]) /
           1e3;
  }
};

void print(const char* to, std::vector<Row>& rows) {
  fmt::print("{:<38} {:>9} {:>9} {:>9}\n", to, "median", "99 %", "most");
  for (Row& row : rows) {
    std::ranges::sort(row.spans_ns);
    fmt::print("{:<38} {:>9.1f} {:>9.1f} {:>9.1f}\n", row.what, row.at_us(0.5), row.at_us(0.99), row.at_us(1.0));
  }
}

/// Says which rows, sorted, miss their goals.
bool meets_goals(const std::vector<Row>& rows) {
  bool met = true;
  for (const Row& row : rows) {
    if (row.goal_us <= 0.0 || row.at_us(0.99) < row.goal_us) continue;
    fmt::print(stderr, "board_bench: {}: {:.0f} us at 99 %, the goal is {:.0f}\n", row.what, row.at_us(0.99),
               row.goal_us);
    met = false;
  }
  return met;
}

/// Shots one after the other, each `ahead_ns` after its order; how far after its instant each was written [ns].
std::vector<std::int64_t> fire(Kicker& kicker, std::atomic<std::int64_t>& shot_ns, int shots, std::int64_t ahead_ns) {
  std::vector<std::int64_t> late_ns;
  for (int i = 0; i < shots; ++i) {
    shot_ns = 0;
    const std::int64_t t_ns = steady_ns() + ahead_ns;
    kicker.fire({i + 1, 1.0, t_ns});
    std::this_thread::sleep_for(std::chrono::nanoseconds(ahead_ns) + std::chrono::milliseconds(7));
    while (shot_ns == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    late_ns.push_back(shot_ns - t_ns);
  }
  return late_ns;
}

/// The same bytes, written by whoever decides.
std::vector<std::int64_t> write_bare(const std::string& path, int shots) {
  const auto line = serial_line(path);
  std::vector<std::int64_t> spans_ns;
  if (line->open({}) != Line::Opening::kOpen) return {0};
  for (int i = 0; i < shots; ++i) {
    const std::int64_t begin_ns = steady_ns();
    line->write(encode(ioboard::frame_of(ioboard::Command::kShoot, 1)), {});
    spans_ns.push_back(steady_ns() - begin_ns);
    std::this_thread::sleep_for(std::chrono::milliseconds(7));
  }
  return spans_ns;
}

/// Threads that take every processor, at the priority of anybody.
class Load {
 public:
  explicit Load(bool wanted) {
    for (unsigned i = 0; wanted && i < 2 * std::thread::hardware_concurrency(); ++i)
      threads_.emplace_back([this] {
        while (!over_) {
        }
      });
  }
  ~Load() {
    over_ = true;
    for (std::thread& thread : threads_) thread.join();
  }
  Load(const Load&) = delete;
  Load& operator=(const Load&) = delete;

 private:
  std::atomic<bool> over_ = false;
  std::vector<std::thread> threads_;
};

struct Plan {
  int shots = 500, priority = 0;
  bool loaded = false, driver = false, goals = false;

  /// An order is to be at the board within 300 us where the machine is idle, ...
  double order_goal_us() const { return loaded ? 0.0 : 300.0; }
  /// ... and a shot within 1 ms of its instant, by SCHED_FIFO also on a loaded one.
  double instant_goal_us() const { return loaded && priority == 0 ? 0.0 : 1000.0; }
};

std::vector<Row> by_the_backend(const Plan& plan) {
  ioboard::Emulator emulator, other;
  std::atomic<std::int64_t> shot_ns = 0;
  const trivela::config::IoBoardDevice settings{.port = emulator.address()};
  BoardKicker kicker{
      std::make_unique<ioboard::IoBoard>(std::make_unique<StampedLine>(settings.port, shot_ns), settings)};
  if (!kicker.connected(std::chrono::seconds(10))) throw std::runtime_error{kicker.status()};
  std::vector<Row> rows{
      {"bare write", write_bare(other.address(), plan.shots)},
      {"order to fire now", fire(kicker, shot_ns, plan.shots, 0), plan.order_goal_us()},
      {"shot in 13 ms, after its instant", fire(kicker, shot_ns, plan.shots, 13'000'000), plan.instant_goal_us()}};
  print("us, to the end of write()", rows);
  return rows;
}

std::vector<Row> by_the_driver(const Plan& plan) {
  auto spans = trivela::bench::measure_driver(plan.shots, plan.priority);
  std::vector<Row> rows{{"bare write", std::move(spans.bare_ns)},
                        {"kick_order on the bus, to fire now", std::move(spans.order_ns), plan.order_goal_us()},
                        {"shot in 13 ms, after its instant", std::move(spans.late_ns), plan.instant_goal_us()}};
  print("us, until the board has read it", rows);
  if (spans.refused > 0) fmt::print("{} orders more had no pulse and were ordered again\n", spans.refused);
  return rows;
}

/// Exit codes: 0 done, 1 failed, 3 a goal missed.
int measure(const Plan& plan) {
  const Load load{plan.loaded};
  if (const sched_param fifo{plan.priority}; plan.priority > 0 && sched_setscheduler(0, SCHED_FIFO, &fifo) != 0)
    throw std::runtime_error{"SCHED_FIFO is not permitted"};
  double others = 0.0;
  if (getloadavg(&others, 1) == 1 && !plan.loaded) fmt::print("load of the machine before: {:.1f}\n", others);
  const std::vector<Row> rows = plan.driver ? by_the_driver(plan) : by_the_backend(plan);
  return !plan.goals || meets_goals(rows) ? 0 : 3;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"How late a shot leaves"};
  Plan plan;
  app.add_option("--shots", plan.shots, "of each kind")->check(CLI::Range(1, 1000000))->capture_default_str();
  app.add_option("--realtime", plan.priority,
                 "SCHED_FIFO priority of the one who orders, which the backend inherits, and of the driver")
      ->check(CLI::Range(1, 99));
  app.add_flag("--load", plan.loaded, "two threads a processor that compute");
  app.add_flag("--driver", plan.driver, "through the bus and a process trivela-kicker_driver");
  app.add_flag(
      "--goals", plan.goals,
      "exit 3 unless at the 99th percentile an order is there within 300 us (without --load) and a shot within "
      "1 ms of its instant (with --load: of --realtime alone)");
  CLI11_PARSE(app, argc, argv);
  try {
    return measure(plan);
  } catch (const std::exception& error) {
    fmt::print(stderr, "board_bench: {}\n", error.what());
    return 1;
  }
}
