// Sensor sample to order over three hops: the bus beside plain UDP sockets, in the same run.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstdlib>

#include "tests/bench/chain/run.hpp"

namespace {

constexpr double kMostTimesUdp = 1.8;       // processes, idle, median
constexpr double kMostInOneProcess_us = 5;  // median, idle

// Whether the idle rows without SCHED_FIFO are as fast as the goals say; names those that are not.
bool goals_met(const std::vector<trivela::bench::Row>& rows) {
  using trivela::bench::quantile_us;
  bool met = true;
  double udp_p50_us = 0;
  for (const auto& row : rows) {
    if (row.loaded || row.realtime) continue;
    const double p50_us = quantile_us(row.latencies_ns, 0.5);
    if (row.contender.starts_with("UDP")) udp_p50_us = p50_us;
    const double most_us = row.contender == "DDS listener, 4 processes"   ? kMostTimesUdp * udp_p50_us
                           : row.contender == "DDS listener, one process" ? kMostInOneProcess_us
                                                                          : p50_us;
    if (p50_us <= most_us) continue;
    met = false;
    fmt::print(stderr, "chain_bench: {} at {} Hz: {:.1f} us at the median, the goal is {:.1f} us\n", row.contender,
               row.rate_hz, p50_us, most_us);
  }
  return met;
}

// The rows called idle are only as idle as the machine.
void warn_if_busy() {
  double load = 0;
  if (getloadavg(&load, 1) == 1 && load > 0.5)
    fmt::print(stderr, "chain_bench: others use this machine (load {:.1f}): the idle rows are not idle\n", load);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Latency from sensor sample to order over three hops, on the bus and over UDP"};
  trivela::bench::Plan plan;
  bool quick = false, goals = false;
  app.add_option("--samples", plan.samples, "samples a row")->check(CLI::Range(1, 1000000))->capture_default_str();
  app.add_option("--rates", plan.rates_hz, "sensor rates in Hz")->check(CLI::Range(1, 10000))->capture_default_str();
  app.add_flag("--quick", quick, "60 samples a row unless --samples says otherwise: some 15 s");
  app.add_flag("--goals", goals, "exit 3 unless the idle medians are at most 1.8 x UDP and 5 us in one process");
  try {
    app.parse(argc, argv);
    if (quick && app.count("--samples") == 0) plan.samples = 60;
    warn_if_busy();
    const auto rows = trivela::bench::run(plan);
    return goals && !goals_met(rows) ? 3 : 0;
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    app.exit(error);
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "chain_bench: {}\n", error.what());
    return 1;
  }
}
