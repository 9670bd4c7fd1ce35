#include "tests/bench/chain/dds_chain.hpp"

#include <memory>

#include "idl/messages.hpp"
#include "tests/bench/chain/pacer.hpp"

namespace trivela::bench {
namespace {

using NodePtr = std::unique_ptr<bus::Node>;
using MakeNode = NodePtr (*)(const bus::Participant&, Track&);

NodePtr odometry(const bus::Participant& participant, Track& track) {
  auto node = std::make_unique<bus::Node>(participant, "odometry", 1);
  node->on_device(
      "wheels", [pacer = Pacer(track)](std::chrono::nanoseconds timeout) mutable { return pacer.next(timeout); },
      [out = node->writer<msg::Odometry>()](const Pacer::Tick& tick) {
        msg::Odometry sample{};
        sample.robot_id = 1;
        sample.seq = static_cast<std::uint64_t>(tick.seq);
        sample.t_ns = tick.t_ns;
        out.write(sample);
      },
      bus::writes<msg::Odometry>());
  return node;
}

// In becomes Out; sequence number and instant pass through.
template <class In, class Out>
NodePtr hop(const bus::Participant& participant, const char* name) {
  auto node = std::make_unique<bus::Node>(participant, name, 1);
  node->template on<In>(
      [out = node->template writer<Out>()](const In& in) {
        Out sample{};
        sample.robot_id = 1;
        sample.seq = in.seq;
        sample.t_ns = in.t_ns;
        out.write(sample);
      },
      bus::writes<Out>());
  return node;
}

NodePtr world_state(const bus::Participant& participant, Track&) {
  return hop<msg::Odometry, msg::WorldState>(participant, "world_state");
}

NodePtr kick_decision(const bus::Participant& participant, Track&) {
  return hop<msg::WorldState, msg::KickOrder>(participant, "kick_decision");
}

NodePtr kicker_driver(const bus::Participant& participant, Track& track) {
  auto node = std::make_unique<bus::Node>(participant, "kicker_driver", 1);
  node->on<msg::KickOrder>(
      [&track](const msg::KickOrder& order) { track.arrived(static_cast<std::int64_t>(order.seq), order.t_ns); });
  return node;
}

constexpr MakeNode kNodes[] = {odometry, world_state, kick_decision, kicker_driver};

// Runs nodes in this process until SIGTERM.
void run(const bus::DomainConfig& domain, bus::Executor::Kind kind, const std::vector<MakeNode>& makers, Track& track) {
  bus::Stop stop;
  const bus::StopOnSignals on_signals(stop);
  const bus::Participant participant(domain);
  std::vector<NodePtr> nodes;
  std::vector<bus::Node*> pointers;
  for (const MakeNode make : makers) pointers.push_back(nodes.emplace_back(make(participant, track)).get());
  bus::Executor(kind, stop, pointers).run();
}

}  // namespace

std::vector<Contender::Process> dds_chain(const bus::DomainConfig& domain, bus::Executor::Kind kind) {
  std::vector<Contender::Process> processes;
  for (const MakeNode make : kNodes) processes.push_back([=](Track& track) { run(domain, kind, {make}, track); });
  return processes;
}

std::vector<Contender::Process> dds_chain_in_one_process(const bus::DomainConfig& domain) {
  return {[domain](Track& track) {
    run(domain, bus::Executor::kListener, {std::begin(kNodes), std::end(kNodes)}, track);
  }};
}

}  // namespace trivela::bench
