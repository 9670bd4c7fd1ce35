// How late a shot leaves: from the order, and from the instant that it was given, to the end of the write() of its
// bytes, on a pseudo-terminal with an emulated ioBoard behind it; beside the same write without the backend, in one
// run.
//
//     board_bench [--shots N] [--realtime PRIORITY] [--load]
#include <CLI/CLI.hpp>

#include <fmt/core.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

#include "hal/board/board_kicker.hpp"
#include "hal/ioboard/emulator.hpp"
#include "hal/ioboard/io_board.hpp"

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

void print(const char* what, std::vector<std::int64_t> spans_ns) {
  std::ranges::sort(spans_ns);
  const auto at = [&](double part) {
    return static_cast<double>(spans_ns[static_cast<std::size_t>(part * static_cast<double>(spans_ns.size() - 1))]) /
           1e3;
  };
  fmt::print("{:<38} {:>9.1f} {:>9.1f} {:>9.1f}\n", what, at(0.5), at(0.99), at(1.0));
}

/// Shots one after the other, each `ahead_ns` after its order; how far after its instant each was written [ns].
std::vector<std::int64_t> fire(Kicker& kicker, std::atomic<std::int64_t>& shot_ns, int shots, std::int64_t ahead_ns) {
  std::vector<std::int64_t> late_ns;
  for (int i = 0; i < shots; ++i) {
    shot_ns = 0;
    const std::int64_t t_ns = steady_ns() + ahead_ns;
    kicker.fire(i + 1, 1.0, t_ns);
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

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"How late a shot leaves"};
  int shots = 500, priority = 0;
  bool loaded = false;
  app.add_option("--shots", shots, "of each kind")->check(CLI::Range(1, 1000000))->capture_default_str();
  app.add_option("--realtime", priority, "SCHED_FIFO priority of the one who orders, which the backend inherits")
      ->check(CLI::Range(1, 99));
  app.add_flag("--load", loaded, "two threads a processor that compute");
  CLI11_PARSE(app, argc, argv);

  const Load load{loaded};
  ioboard::Emulator emulator, other;
  if (const sched_param fifo{priority}; priority > 0 && sched_setscheduler(0, SCHED_FIFO, &fifo) != 0) {
    fmt::print(stderr, "board_bench: SCHED_FIFO is not permitted\n");
    return 1;
  }
  std::atomic<std::int64_t> shot_ns = 0;
  const trivela::config::IoBoardDevice settings{.port = emulator.address()};
  BoardKicker kicker{
      std::make_unique<ioboard::IoBoard>(std::make_unique<StampedLine>(settings.port, shot_ns), settings),
      std::chrono::minutes(1)};  // none is dropped
  if (!kicker.connected(std::chrono::seconds(10))) {
    fmt::print(stderr, "board_bench: {}\n", kicker.status());
    return 1;
  }
  fmt::print("{:<38} {:>9} {:>9} {:>9}\n", "us, to the end of write()", "median", "99 %", "most");
  print("bare write", write_bare(other.address(), shots));
  print("order to fire now", fire(kicker, shot_ns, shots, 0));
  print("shot in 13 ms, after its instant", fire(kicker, shot_ns, shots, 13'000'000));
}
