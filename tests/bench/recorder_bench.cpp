// How many decisions a second the recorder holds: writers of another process, the bus, the recorder node, the disk.
#include <fmt/core.h>
#include <poll.h>
#include <spdlog/sinks/null_sink.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <optional>
#include <thread>

#include "bus/executor.hpp"
#include "log/read/reader.hpp"
#include "nodes/recorder/recorder_node.hpp"
#include "tests/bench/chain/contender.hpp"
#include "tests/bench/chain/hogs.hpp"
#include "tests/support/folder.hpp"

namespace trivela::bench {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kTimeout{20};

struct Plan {
  int robots = 5;
  double rate_hz = 1000.0;  // of each robot
  double seconds = 10.0;
  bool loaded = false;  // with every core busy
};

/// What the writers' process says when it is through.
struct Sent {
  std::int64_t decisions = 0;
  double wall_s = 0.0;
  double cpu_s = 0.0;
};

struct Result {
  Sent sent;
  double cpu_s = 0.0;  // of the recorder
  log::Stats stats;
  std::int64_t recorded = 0;  // decisions in the log
  std::int64_t shadows = 0;
  std::int64_t gaps = 0;      // sequence numbers that never arrived
  std::int64_t overflow = 0;  // rows that found the queue full
  std::int64_t refused = 0;   // rows that the log did not take
};

double cpu_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// A decision as a robot with the ball takes it, a shadow beside it.
msg::KickDecision decision(int robot, std::int64_t tick, std::int64_t period_ns) {
  const double phase = 1e-3 * static_cast<double>(tick);
  msg::KickDecision out{};
  out.robot_id = static_cast<std::uint8_t>(robot);
  out.seq = static_cast<std::uint64_t>(tick) + 1;
  out.t_ns = tick * period_ns;
  out.half = 1;
  out.possession_id = static_cast<std::uint32_t>(tick / 1000) + 1;
  out.policy = msg::POLICY_MOVING;
  out.reason = msg::REASON_NOT_ALIGNED;
  out.x_m = std::sin(phase);
  out.y_m = 3.0 + std::cos(phase);
  out.heading_rad = 0.1 * std::sin(3.0 * phase);
  out.target_y_m = 9.0;
  out.target_z_m = 0.7;
  out.distance_m = std::hypot(out.x_m, 9.0 - out.y_m);
  out.v0_mps = 8.0 + std::sin(phase);
  out.v_kick_mps = out.v0_mps - 1.0;
  out.power = 20.0 + std::sin(phase);
  out.charge = 1.0;
  out.shadow_count = 1;
  out.shadows[0].policy = msg::POLICY_STOPPED;
  out.shadows[0].reason = msg::REASON_SETTLING;
  out.shadows[0].power = out.power;
  return out;
}

/// The robots: a writer each, all in step, paced by the clock; says what it sent and stays until `release` ends, so
/// that what is on its way arrives.
void play_robots(const bus::DomainConfig& domain, const Plan& plan, int report, int release) {
  const bus::Participant participant{domain};
  std::vector<bus::Writer<msg::KickDecision>> writers;
  for (int robot = 1; robot <= plan.robots; ++robot) writers.emplace_back(participant);
  for (const auto& writer : writers) {
    // The recorder and the one that watches for its match.
    if (!writer.wait_for_readers(2, kTimeout)) throw std::runtime_error{"the recorder has not come within 20 s"};
  }
  char go = 'r';
  if (write(report, &go, 1) != 1 || read(release, &go, 1) != 1)
    throw std::runtime_error{"the recorder has not found the robots"};
  const auto period_ns = static_cast<std::int64_t>(1e9 / plan.rate_hz);
  const auto ticks = static_cast<std::int64_t>(plan.seconds * plan.rate_hz);
  const double cpu_before_s = cpu_s();
  const auto started = Clock::now();
  timespec until{};
  clock_gettime(CLOCK_MONOTONIC, &until);
  for (std::int64_t tick = 0; tick < ticks; ++tick) {
    for (int robot = 1; robot <= plan.robots; ++robot)
      writers[static_cast<std::size_t>(robot) - 1].write(decision(robot, tick, period_ns));
    until.tv_nsec += period_ns;
    until.tv_sec += until.tv_nsec / 1'000'000'000;
    until.tv_nsec %= 1'000'000'000;
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) != 0) continue;
  }
  const Sent sent{ticks * plan.robots, std::chrono::duration<double>{Clock::now() - started}.count(),
                  cpu_s() - cpu_before_s};
  if (write(report, &sent, sizeof sent) != sizeof sent) throw std::runtime_error{"nobody waits for the robots"};
  char end = 0;
  while (read(release, &end, 1) > 0) continue;
}

class Pipe {
 public:
  Pipe() {
    if (pipe(ends_) != 0) throw std::runtime_error{"no pipe"};
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  int read_end() const { return ends_[0]; }
  int write_end() const { return ends_[1]; }
  void close_end(int which) {
    if (ends_[which] >= 0) close(ends_[which]);
    ends_[which] = -1;
  }

 private:
  int ends_[2] = {-1, -1};
};

/// Waits until the rows are in the log, or none has come for a second: what is missing then will not come.
void drain(log::Writer& log, std::int64_t rows) {
  std::int64_t before = -1;
  auto last_news = Clock::now();
  while (Clock::now() - last_news < std::chrono::seconds(1)) {
    log.flush();
    const auto stats = log.stats();
    const std::int64_t now = stats.rows_written + stats.rows_missing;
    if (now >= rows) return;
    if (now != before) last_news = Clock::now();
    before = now;
    poll(nullptr, 0, 10);
  }
}

/// Every robot's writer is there, and the robots say that they have their reader. A writer may know a reader before the
/// reader knows the writer, and then its first samples are nobody's.
bool robots_are_ready(bus::Participant& participant, const Plan& plan, const Pipe& report) {
  bus::Reader<msg::KickDecision> watch{participant};
  char ready = 0;
  return watch.wait_for_writers(static_cast<std::size_t>(plan.robots), kTimeout) &&
         read(report.read_end(), &ready, 1) == 1;
}

/// What of it stands in the log, and what the log says is missing.
void add_log(Result& result, const fs::path& path) {
  const log::Reader reader{path};
  reader.query("SELECT (SELECT count(*) FROM kick_decisions), (SELECT count(*) FROM shadow_decisions)",
               [&](std::int64_t decisions, std::int64_t shadows) {
                 result.recorded = decisions;
                 result.shadows = shadows;
               });
  for (const auto& loss : reader.losses()) {
    result.gaps += loss.gaps;
    result.overflow += loss.overflow;
    result.refused += loss.nan_refused + loss.rejected;
  }
}

Result measure(const Plan& plan) {
  const bus::DomainConfig domain =
      bus::loopback(1 + static_cast<unsigned>(getpid()) % 100, fmt::format("recorder-bench-{}", getpid()));
  std::optional<Hogs> hogs;
  if (plan.loaded) hogs.emplace();
  Pipe report, release;  // after the hogs, which would keep their ends
  // A child before any participant: Cyclone's threads do not survive a fork.
  const pid_t robots = fork_child([&] {
    release.close_end(1);
    play_robots(domain, plan, report.write_end(), release.read_end());
  });
  report.close_end(1);
  const tests::Folder folder;
  const fs::path path = folder.path() / "match.db";
  bus::Stop stop;
  config::Settings settings;
  const auto logger = std::make_shared<spdlog::logger>("recorder", std::make_shared<spdlog::sinks::null_sink_mt>());
  nodes::NodeContext context{settings, {}, bus::Participant{domain}, logger, stop};
  log::WriterOptions options;
  options.queue_capacity = settings.recorder.queue_capacity;
  options.group_commit_s = settings.recorder.group_commit_s;
  log::Writer log{path, log::Session{}, options};
  nodes::RecorderNode node{context, log};
  const double cpu_before_s = cpu_s();
  std::thread recording{[&] { bus::Executor{bus::Executor::kWaitset, stop, {&node.node()}}.run(); }};
  if (!robots_are_ready(context.participant, plan, report)) release.close_end(1);
  if (write(release.write_end(), "g", 1) != 1) fmt::print(stderr, "the robots' process is gone\n");
  Result result;
  const bool reported = read(report.read_end(), &result.sent, sizeof result.sent) == sizeof result.sent;
  result.cpu_s = cpu_s() - cpu_before_s;
  if (reported) drain(log, 2 * result.sent.decisions);
  stop.request();
  recording.join();
  log.finalise();
  release.close_end(1);
  waitpid(robots, nullptr, 0);
  if (!reported) throw std::runtime_error{"the robots' process failed"};

  result.stats = log.stats();
  add_log(result, path);
  return result;
}

void print(const Plan& plan, const Result& result) {
  const auto percent = [&](double cpu) { return fmt::format("{:.0f} %", 100.0 * cpu / result.sent.wall_s); };
  fmt::print("{:>6} {:>8} {:<7} {:>9} {:>11} {:>9} {:>9} {:>11} {:>6} {:>9} {:>8} {:>13} {:>11}\n", "robots", "rate_hz",
             "load", "wall_s", "decisions/s", "sent", "missing", "high_water", "gaps", "overflow", "refused",
             "recorder_cpu", "robots_cpu");
  fmt::print("{:>6} {:>8.0f} {:<7} {:>9.2f} {:>11.0f} {:>9} {:>9} {:>11} {:>6} {:>9} {:>8} {:>13} {:>11}\n",
             plan.robots, plan.rate_hz, plan.loaded ? "loaded" : "idle", result.sent.wall_s,
             static_cast<double>(result.sent.decisions) / result.sent.wall_s, result.sent.decisions,
             result.sent.decisions - result.recorded, result.stats.queue_high_water, result.gaps, result.overflow,
             result.refused, percent(result.cpu_s), percent(result.sent.cpu_s));
  fmt::print(
      "{} rows in the log (decisions and shadows), {:.0f} a second in {} groups, none committed later than {:.3f} s "
      "after its push\n",
      result.stats.rows_written, result.stats.rows_per_s, result.stats.commits, result.stats.oldest_row_s);
}

}  // namespace
}  // namespace trivela::bench

int main(int argc, char** argv) {
  using namespace trivela::bench;
  CLI::App app{"Decisions of several robots over the bus into a match log: rows a second, and whether any is lost"};
  Plan plan;
  bool quick = false;
  app.add_option("--robots", plan.robots, "robots, a writer each")->check(CLI::Range(1, 200))->capture_default_str();
  app.add_option("--rate-hz", plan.rate_hz, "decisions a second of each")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str();
  app.add_option("--seconds", plan.seconds, "how long")->check(CLI::Range(0.01, 3600.0))->capture_default_str();
  app.add_flag("--loaded", plan.loaded, "with a process per core that does nothing but use it");
  app.add_flag("--quick", quick, "one second");
  app.footer("Exit codes: 0 nothing lost, 1 failed, 2 bad usage, 3 decisions were lost.");
  try {
    app.parse(argc, argv);
    if (quick) plan.seconds = 1.0;
    const Result result = measure(plan);
    print(plan, result);
    const bool whole = result.recorded == result.sent.decisions && result.shadows == result.sent.decisions;
    return whole && result.gaps + result.overflow + result.refused == 0 ? 0 : 3;
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    app.exit(error);
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "recorder_bench: {}\n", error.what());
    return 1;
  }
}
