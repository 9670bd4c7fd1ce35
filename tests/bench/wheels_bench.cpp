// What part of a core the drives of a base take: the backend cia402 over a SOCK_SEQPACKET socket in place of a CAN bus,
// set-points and samples at a rate, emulated drives in a process of their own, which is not counted.
//
//     wheels_bench [--drives N] [--hz RATE] [--seconds S] [--goals]
#include <CLI/CLI.hpp>

#include <fmt/core.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "emulators/cia402/emulated_wheels.hpp"
#include "hal/can/can_line.hpp"
#include "hal/cia402/cia402_wheels.hpp"

namespace {

using namespace trivela::hal;
using std::chrono::steady_clock;

/// Emulated drives in a process that ends with this object.
class Drives {
 public:
  explicit Drives(int count) {
    std::array<int, 2> pipe{};
    if (::pipe(pipe.data()) != 0) return;
    id_ = ::fork();
    if (id_ == 0) {
      cia402::Emulator emulator{static_cast<std::uint8_t>(count)};
      const std::string port = emulator.address();
      if (::write(pipe[1], port.data(), port.size()) > 0) ::pause();
      ::_exit(0);
    }
    std::array<char, 256> port{};
    const ssize_t size = ::read(pipe[0], port.data(), port.size());
    port_.assign(port.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
  }
  ~Drives() {
    ::kill(id_, SIGTERM);
    ::waitpid(id_, nullptr, 0);
  }
  Drives(const Drives&) = delete;
  Drives& operator=(const Drives&) = delete;
  const std::string& port() const { return port_; }

 private:
  pid_t id_ = 0;
  std::string port_;
};

double processor_s() {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"What part of a core the drives take"};
  int count = 4;
  double rate_hz = 200.0, span_s = 10.0;
  bool goals = false;
  app.add_option("--drives", count)->check(CLI::Range(3, 4))->capture_default_str();
  app.add_option("--hz", rate_hz, "of set-points and samples")->check(CLI::Range(20.0, 500.0))->capture_default_str();
  app.add_option("--seconds", span_s)->check(CLI::Range(1.0, 3600.0))->capture_default_str();
  app.add_flag("--goals", goals, "exit 3 unless it is less than 10 % of a core, at 95 % of the rate or more");
  CLI11_PARSE(app, argc, argv);

  const Drives drives{count};
  trivela::config::Cia402Device settings{
      .port = drives.port(), .gear = 23.0, .heartbeat_s = 1.0, .cycle_s = 1.0 / rate_hz};
  trivela::kicking::WheelBase base;
  if (count == 4) base.wheel_angles_rad = {0.7, 2.44, 3.84, 5.58};
  settings.nodes.clear();
  for (int node = 1; node <= count; ++node) settings.nodes.push_back(static_cast<std::uint8_t>(node));
  cia402::Cia402Wheels wheels{can::can_line(settings.port), settings, base};
  if (!wheels.connected(std::chrono::seconds(10))) {
    fmt::print(stderr, "wheels_bench: {}\n", wheels.status());
    return 1;
  }
  const auto begin = steady_clock::now();
  const double before_s = processor_s();
  std::uint64_t samples = 0;
  for (const auto end = begin + std::chrono::duration<double>(span_s); steady_clock::now() < end;) {
    const auto sample = wheels.read(std::chrono::seconds(1));
    if (sample) wheels.drive({0.5, 1.0, 0.2}, sample->t_ns);
    samples += sample ? 1 : 0;
  }
  const double passed_s = std::chrono::duration<double>(steady_clock::now() - begin).count();
  const double sampled_hz = static_cast<double>(samples) / passed_s;
  const double part_percent = 100.0 * (processor_s() - before_s) / passed_s;
  fmt::print(
      "{} drives, {:.1f} samples and set-points a second: {:.2f} % of a core (SOCK_SEQPACKET, no CAN controller)\n",
      count, sampled_hz, part_percent);
  if (!goals || (part_percent < 10.0 && sampled_hz > 0.95 * rate_hz)) return 0;
  fmt::print(stderr, "wheels_bench: the goal is less than 10 % of a core at {:g} Hz\n", rate_hz);
  return 3;
}
