#include "tests/bench/chain/dds_chain.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "bus/writer.hpp"
#include "idl/messages.hpp"
#include "tests/bench/chain/pacer.hpp"

namespace trivela::bench {
namespace {

using NodePtr = std::unique_ptr<bus::Node>;
using MakeNode = NodePtr (*)(const bus::Participant&, Track&);

struct Stage {
  const char* name;
  MakeNode make;
};

msg::Odometry sample_of(const Pacer::Tick& tick) {
  msg::Odometry sample{};
  sample.robot_id = 1;
  sample.seq = static_cast<std::uint64_t>(tick.seq);
  sample.t_ns = tick.t_ns;
  return sample;
}

NodePtr paced_odometry(const bus::Participant& participant, Pacer pacer) {
  auto node = std::make_unique<bus::Node>(participant, "odometry", 1);
  node->on_device(
      "wheels", [pacer = std::move(pacer)](std::chrono::nanoseconds timeout) mutable { return pacer.next(timeout); },
      [out = node->writer<msg::Odometry>()](const Pacer::Tick& tick) { out.write(sample_of(tick)); },
      bus::writes<msg::Odometry>());
  return node;
}

NodePtr odometry(const bus::Participant& participant, Track& track) {
  return paced_odometry(participant, Pacer(track));
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

constexpr Stage kStages[] = {{"odometry", odometry},
                             {"world_state", world_state},
                             {"kick_decision", kick_decision},
                             {"kicker_driver", kicker_driver}};

/// The nodes after the first.
std::vector<NodePtr> listening_nodes(const bus::Participant& participant, Track& track) {
  std::vector<NodePtr> nodes;
  for (const MakeNode make : {world_state, kick_decision, kicker_driver}) nodes.push_back(make(participant, track));
  return nodes;
}

// Runs the nodes in this process until SIGTERM.
void run(bus::Executor::Kind kind, bus::Stop& stop, const std::vector<NodePtr>& nodes) {
  std::vector<bus::Node*> pointers;
  for (const NodePtr& node : nodes) pointers.push_back(node.get());
  bus::Executor(kind, stop, pointers).run();
}

// Nodes in a domain of their own, of which an order arrives nowhere: their sink is a track that nobody waits for.
class Twin {
 public:
  explicit Twin(const bus::DomainConfig& domain)
      : participant_(domain), nodes_(listening_nodes(participant_, track_)), out_(participant_) {
    runs_ = std::jthread([this] { run(bus::Executor::kListener, stop_, nodes_); });
    if (!out_.wait_for_readers(1, std::chrono::seconds(30))) throw std::runtime_error("the twin never came together");
  }
  ~Twin() { stop_.request(); }
  Twin(const Twin&) = delete;
  Twin& operator=(const Twin&) = delete;

  void rehearse() { out_.write(sample_of({0, now_ns()})); }

 private:
  Track track_;
  bus::Stop stop_;
  bus::Participant participant_;
  std::vector<NodePtr> nodes_;
  bus::Writer<msg::Odometry> out_;
  std::jthread runs_;
};

}  // namespace

std::vector<Contender::Process> dds_chain(const DomainOf& domain, bus::Executor::Kind kind) {
  std::vector<Contender::Process> processes;
  for (const Stage& stage : kStages) {
    processes.push_back([=, config = domain(stage.name)](Track& track) {
      bus::Stop stop;
      const bus::StopOnSignals on_signals(stop);
      std::vector<NodePtr> nodes;
      nodes.push_back(stage.make(bus::Participant(config), track));
      run(kind, stop, nodes);
    });
  }
  return processes;
}

std::vector<Contender::Process> dds_chain_in_one_process(const bus::DomainConfig& domain, const Rehearsal& rehearsal) {
  return {[=](Track& track) {
    bus::Stop stop;
    const bus::StopOnSignals on_signals(stop);
    const bus::Participant participant(domain);
    std::vector<NodePtr> nodes = listening_nodes(participant, track);
    std::optional<Twin> twin;
    std::optional<bus::Writer<msg::Odometry>> dry;
    std::function<void()> before;
    if (rehearsal.twin) before = [&twin = twin.emplace(*rehearsal.twin)] { twin.rehearse(); };
    if (rehearsal.dry_sample) before = [&out = dry.emplace(participant)] { out.write(sample_of({0, now_ns()})); };
    nodes.push_back(paced_odometry(participant, Pacer(track, before, rehearsal.busy_wait)));
    run(bus::Executor::kListener, stop, nodes);
  }};
}

}  // namespace trivela::bench
