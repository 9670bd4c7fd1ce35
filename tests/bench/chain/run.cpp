#include "tests/bench/chain/run.hpp"

#include <fmt/core.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <deque>
#include <optional>

#include "bus/process.hpp"
#include "tests/bench/chain/contender.hpp"
#include "tests/bench/chain/dds_chain.hpp"
#include "tests/bench/chain/hogs.hpp"
#include "tests/bench/chain/udp_chain.hpp"

namespace trivela::bench {
namespace {

constexpr int kPriority = 50;
constexpr std::int64_t kSamplesPerTurn = 50;

// Asked in a child, so that the parent stays an ordinary process.
bool realtime_permitted() {
  const pid_t child = fork_child([] {
    const auto permitted = bus::set_realtime(kPriority);
    _exit(permitted.scheduled && permitted.memory_locked ? 0 : 1);
  });
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

// Each contender on the bus has a domain of its own; the tag keeps out other runs.
bus::DomainConfig domain(int index) {
  return bus::loopback(static_cast<std::uint32_t>((getpid() + index) % 100 + 1),
                       fmt::format("chain-{}-{}", getpid(), index));
}

void run_condition(std::deque<Contender>& contenders, Row condition, std::int64_t samples, std::vector<Row>& rows) {
  std::vector<Row> mine;
  for (const Contender& contender : contenders) {
    condition.contender = contender.name();
    mine.push_back(condition);
  }
  const std::int64_t period_ns = 1'000'000'000 / condition.rate_hz;
  for (std::int64_t done = 0; done < samples; done += kSamplesPerTurn) {
    const std::int64_t count = std::min(kSamplesPerTurn, samples - done);
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      const auto latencies_ns = contenders[i].track().run_batch(count, period_ns);
      mine[i].sent += count;
      mine[i].latencies_ns.insert(mine[i].latencies_ns.end(), latencies_ns.begin(), latencies_ns.end());
    }
  }
  const double udp_p50_us = quantile_us(mine.front().latencies_ns, 0.5);
  for (Row& row : mine) {
    print_row(row, udp_p50_us);
    rows.push_back(std::move(row));
  }
}

}  // namespace

std::vector<Row> run(const Plan& plan) {
  std::vector<Row> rows;
  print_heading();
  for (const bool realtime : {false, true}) {
    if (realtime && !realtime_permitted()) {
      fmt::print(stderr, "chain_bench: SCHED_FIFO or locked memory is not permitted here; its rows are left out\n");
      break;
    }
    const int priority = realtime ? kPriority : 0;
    std::deque<Contender> contenders;
    contenders.emplace_back("UDP, 4 processes", udp_chain(), priority);
    contenders.emplace_back("DDS listener, 4 processes", dds_chain(domain(0), bus::Executor::kListener), priority);
    contenders.emplace_back("DDS waitset, 4 processes", dds_chain(domain(1), bus::Executor::kWaitset), priority);
    contenders.emplace_back("DDS listener, one process", dds_chain_in_one_process(domain(2)), priority);
    for (Contender& contender : contenders) contender.warm_up();
    for (const bool loaded : {false, true}) {
      std::optional<Hogs> hogs;
      if (loaded) hogs.emplace();
      for (const int rate_hz : plan.rates_hz)
        run_condition(contenders, {rate_hz, loaded, realtime, {}, 0, {}}, plan.samples, rows);
    }
  }
  return rows;
}

}  // namespace trivela::bench
