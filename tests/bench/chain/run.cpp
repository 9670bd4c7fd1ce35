#include "tests/bench/chain/run.hpp"

#include <fmt/core.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <deque>
#include <filesystem>
#include <optional>

#include "bus/domain/process.hpp"
#include "tests/bench/chain/bare_chain.hpp"
#include "tests/bench/chain/contender.hpp"
#include "tests/bench/chain/dds_chain.hpp"
#include "tests/bench/chain/domains.hpp"
#include "tests/bench/chain/goals.hpp"
#include "tests/bench/chain/hogs.hpp"
#include "tests/bench/chain/processor_time.hpp"
#include "tests/bench/chain/secured_chain.hpp"
#include "tests/bench/chain/tuning.hpp"
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

// A contender before its processes exist.
struct Entrant {
  const char* name;
  std::vector<Contender::Process> processes;
  const char* reference = "";
};

std::deque<Contender> started(const std::vector<Entrant>& entrants, int priority) {
  std::deque<Contender> contenders;
  for (const Entrant& entrant : entrants)
    contenders.emplace_back(entrant.name, entrant.processes, priority, entrant.reference);
  for (Contender& contender : contenders) contender.warm_up();
  return contenders;
}

DomainOf everywhere(int index) {
  return [config = own_domain(index)](const std::string&) { return config; };
}

std::vector<Entrant> chains(const DomainOf& secured_domain) {
  return {{kUdp, udp_chain()},
          {kBare, bare_chain_in_processes(own_domain(0))},
          {kListener, dds_chain(everywhere(1), bus::Executor::kListener), kBare},
          {"DDS waitset, 4 processes", dds_chain(everywhere(2), bus::Executor::kWaitset), kBare},
          {kSecured, dds_chain(secured_domain, bus::Executor::kListener), kListener},
          {kBareOne, bare_chain_in_one_process(own_domain(4))},
          {kOne, dds_chain_in_one_process(own_domain(5)), kBareOne}};
}

constexpr const char* kPlain = "one process, as it is";
constexpr const char* kPlainFour = "4 processes, as they are";

std::vector<Entrant> tries() {
  const auto one = [](int index, const Tuning& tuning, const Rehearsal& rehearsal = {}) {
    return tuned(tuning, dds_chain_in_one_process(own_domain(index), rehearsal));
  };
  const auto four = [](int index, const Tuning& tuning) {
    return tuned(tuning, dds_chain(everywhere(index), bus::Executor::kListener));
  };
  const Tuning all{.awake = true, .scheduled = true, .pinned = true, .locked = true, .huge = true};
  return {{kUdp, udp_chain()},
          {kPlain, one(0, {})},
          {"processors awake", one(1, {.awake = true}), kPlain},
          {"SCHED_FIFO", one(2, {.scheduled = true}), kPlain},
          {"pinned", one(3, {.pinned = true}), kPlain},
          {"memory locked", one(4, {.locked = true}), kPlain},
          {"huge pages", one(5, {.huge = true}), kPlain},
          {"last ms busy", one(6, {}, {.busy_wait = true}), kPlain},
          {"path touched by a twin", one(7, {}, {.twin = own_domain(8)}), kPlain},
          {"last ms busy, touched", one(9, {}, {.twin = own_domain(10), .busy_wait = true}), kPlain},
          {"all of these", one(11, all, {.twin = own_domain(12), .busy_wait = true}), kPlain},
          {"a dry sample (no way: orders)", one(13, {}, {.dry_sample = true}), kPlain},
          {kPlainFour, four(14, {})},
          {"4, processors awake", four(15, {.awake = true}), kPlainFour},
          {"4, SCHED_FIFO", four(16, {.scheduled = true}), kPlainFour},
          {"4, on one processor", four(17, {.pinned = true}), kPlainFour},
          {"4, memory locked", four(18, {.locked = true}), kPlainFour},
          {"4, all of these", four(19, all), kPlainFour}};
}

// What protects every topic of the four processes, one way each; first none of it, then as a robot has it.
std::vector<Entrant> protections(const std::filesystem::path& folder) {
  struct Way {
    const char* name;
    Protection protection;
  };
  static constexpr Way kWays[] = {
      {"certificates alone", {"NONE", "NONE", "NONE"}},   {"packets signed", {"SIGN", "NONE", "NONE"}},
      {"packets encrypted", {"ENCRYPT", "NONE", "NONE"}}, {"parts signed", {"NONE", "SIGN", "NONE"}},
      {"parts encrypted", {"NONE", "ENCRYPT", "NONE"}},   {"payload encrypted", {"NONE", "NONE", "ENCRYPT"}}};
  std::vector<Entrant> entrants = {
      {kUdp, udp_chain()},
      {kListener, dds_chain(everywhere(0), bus::Executor::kListener)},
      {kSecured, dds_chain(secured(1, folder / "usual"), bus::Executor::kListener), kListener}};
  int index = 2;
  for (const Way& way : kWays)
    entrants.push_back({way.name,
                        dds_chain(secured(index++, folder / way.name, &way.protection), bus::Executor::kListener),
                        kListener});
  return entrants;
}

void run_condition(std::deque<Contender>& contenders, Row condition, std::int64_t samples, std::vector<Row>& rows) {
  std::vector<Row> mine;
  for (const Contender& contender : contenders) {
    condition.contender = contender.name();
    condition.reference = contender.reference();
    mine.push_back(condition);
  }
  const ProcessorTime before = processor_time();
  const std::int64_t period_ns = 1'000'000'000 / condition.rate_hz;
  for (std::int64_t done = 0; done < samples; done += kSamplesPerTurn) {
    const std::int64_t count = std::min(kSamplesPerTurn, samples - done);
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      const auto latencies_ns = contenders[i].track().run_batch(count, period_ns);
      mine[i].sent += count;
      mine[i].latencies_ns.insert(mine[i].latencies_ns.end(), latencies_ns.begin(), latencies_ns.end());
    }
  }
  const double busy = busy_share(before, processor_time());
  for (Row& row : mine) row.busy = busy;
  for (const Row& row : mine) print_row(row, mine);
  rows.insert(rows.end(), mine.begin(), mine.end());
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
    const TemporaryKeys keys;
    std::deque<Contender> contenders = started(chains(secured(3, keys.folder())), realtime ? kPriority : 0);
    for (const bool loaded : {false, true}) {
      std::optional<Hogs> hogs;
      if (loaded) hogs.emplace();
      for (const int rate_hz : plan.rates_hz)
        run_condition(contenders, {.rate_hz = rate_hz, .loaded = loaded, .realtime = realtime}, plan.samples, rows);
    }
  }
  return rows;
}

std::vector<Row> run_tries(const Plan& plan) {
  std::vector<Row> rows;
  // Asked in a child: contenders are made before their parent knows the bus.
  waitpid(fork_child([] {
            fmt::print("{}\n", about_loans());
            std::fflush(stdout);
          }),
          nullptr, 0);
  print_heading();
  std::deque<Contender> contenders = started(tries(), 0);
  for (const int rate_hz : plan.rates_hz) run_condition(contenders, {.rate_hz = rate_hz}, plan.samples, rows);
  return rows;
}

std::vector<Row> run_protections(const Plan& plan) {
  std::vector<Row> rows;
  print_heading();
  const TemporaryKeys keys;
  std::deque<Contender> contenders = started(protections(keys.folder()), 0);
  for (const int rate_hz : plan.rates_hz) run_condition(contenders, {.rate_hz = rate_hz}, plan.samples, rows);
  return rows;
}

}  // namespace trivela::bench
