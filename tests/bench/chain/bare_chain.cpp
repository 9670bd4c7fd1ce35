#include "tests/bench/chain/bare_chain.hpp"

#include <memory>
#include <stdexcept>

#include "bus/stop.hpp"
#include "tests/bench/chain/bare_cyclone.h"
#include "tests/bench/chain/pacer.hpp"

namespace trivela::bench {
namespace {

void run(const bus::DomainConfig& domain, int stages, Track& track) {
  bus::Stop stop;
  const bus::StopOnSignals on_signals(stop);
  const auto arrived = [](void* context, std::int64_t seq, std::int64_t t_ns) {
    static_cast<Track*>(context)->arrived(seq, t_ns);
  };
  const std::unique_ptr<bare_chain, decltype(&bare_chain_close)> chain(
      bare_chain_open(domain.domain_id, domain.xml.c_str(), stages, arrived, &track), bare_chain_close);
  if (!chain) throw std::runtime_error("bare Cyclone: the chain cannot be made");
  if ((stages & kBareOdometry) == 0) return stop.wait();
  for (Pacer pacer(track); !stop.requested();) {
    const auto tick = pacer.next(std::chrono::milliseconds(100));
    if (tick && bare_chain_write(chain.get(), tick->seq, tick->t_ns) != 0)
      throw std::runtime_error("bare Cyclone: a sample was not written");
  }
}

}  // namespace

std::vector<Contender::Process> bare_chain_in_processes(const bus::DomainConfig& domain) {
  std::vector<Contender::Process> processes;
  for (const int stage : {kBareOdometry, kBareWorldState, kBareKickDecision, kBareKickerDriver})
    processes.push_back([=](Track& track) { run(domain, stage, track); });
  return processes;
}

std::vector<Contender::Process> bare_chain_in_one_process(const bus::DomainConfig& domain) {
  return {[domain](Track& track) {
    run(domain, kBareOdometry | kBareWorldState | kBareKickDecision | kBareKickerDriver, track);
  }};
}

}  // namespace trivela::bench
