#include "tests/faults/stack.hpp"

#include <fmt/core.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <stdexcept>

namespace trivela::faults {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int kDomain = 77;
constexpr std::chrono::milliseconds kPollInterval{20};
constexpr std::chrono::seconds kGrace{10};

constexpr const char* kHostsXml = R"(<CycloneDDS xmlns="https://cdds.io/config"><Domain Id="any">
  <General><Interfaces><NetworkInterface name="tap0"/></Interfaces><AllowMulticast>spdp</AllowMulticast>
    <MaxMessageSize>1400B</MaxMessageSize><MaxRexmitMessageSize>1400B</MaxRexmitMessageSize><FragmentSize>1344B</FragmentSize></General>
  <Discovery><Tag>faults</Tag><SPDPInterval>1s</SPDPInterval><LeaseDuration>5s</LeaseDuration></Discovery>
</Domain></CycloneDDS>
)";

constexpr const char* kLoopbackXml = R"(<CycloneDDS xmlns="https://cdds.io/config"><Domain Id="any">
  <General><Interfaces><NetworkInterface name="lo"/></Interfaces><AllowMulticast>false</AllowMulticast></General>
  <Discovery><Tag>faults-{}</Tag><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>60</MaxAutoParticipantIndex>
    <Peers><Peer address="127.0.0.1"/></Peers><SPDPInterval>1s</SPDPInterval><LeaseDuration>5s</LeaseDuration></Discovery>
</Domain></CycloneDDS>
)";

// The robot kicks often, and the referee often stops it while it has the ball.
constexpr const char* kScenario = R"([kicker]
recharge_per_s = 5.0
[possession]
goal_distance_max_m = 6.0
aim_error_sd_deg = 20.0
time_limit_s = 4.0
flight_limit_s = 1.5
after_crossing_s = 0.1
[opponent]
distance_median_m = 4.0
[referee]
stops_per_min = 15.0
)";

constexpr const char* kSettings = R"([run]
robot = "{0}/config/robots/cambada_1.toml"
scenario = "{1}/scenario.toml"
[domain]
domain_id = {2}
dds_file = "{1}/cyclonedds.xml"
[kick_decision]
policy_by_half = ["moving"]
order_validity_s = 0.05
[recorder]
log = "{1}/match.db"
[simulator]
halves = 1
half_minutes = 1000.0
)";

/// A program of the campaign's own, which takes the bus from its environment.
ProcessPlan foreign_plan(const StackPlan& stack, const char* program) {
  ProcessPlan plan;
  plan.program = stack.own / program;
  plan.arguments = {std::to_string(kDomain)};
  plan.environment = {{"CYCLONEDDS_URI", "file://" + (stack.folder / "cyclonedds.xml").string()}};
  return plan;
}

}  // namespace

Stack::Stack(const StackPlan& plan) : plan_(plan) {
  write_configuration();
  if (plan_.with_links) {
    std::vector<Hub::Cable> cables;
    for (std::uint8_t number = 1; number <= kNodes.size() + 1; ++number) {
      const NetworkHost& host = hosts_.emplace_back(number);
      cables.push_back({host.cable(), number});
    }
    hub_ = std::make_unique<Hub>(std::move(cables), plan_.seed);
    hub_->keep_garbled(node_index("kicker_driver"));
  }
  renew_device_witness();
  start_witness(wire_, "witness_wire", network(kNodes.size()));
  ProcessPlan client = foreign_plan(plan_, "fault_client");
  client.says = plan_.folder / "client.txt";
  client.network = network(node_index("kick_decision"));
  client_ = std::make_unique<NodeProcess>(client);
}

int Stack::network(std::size_t host) const { return hosts_.empty() ? -1 : hosts_[host].network(); }

void Stack::renew_device_witness() { start_witness(device_, "witness_device", network(node_index("kicker_driver"))); }

void Stack::write_configuration() const {
  std::ofstream{plan_.folder / "cyclonedds.xml"}
      << (plan_.with_links ? std::string{kHostsXml} : fmt::format(kLoopbackXml, getpid()));
  std::ofstream{plan_.folder / "scenario.toml"} << kScenario;
  std::ofstream{plan_.folder / "nodes.toml"}
      << fmt::format(kSettings, TRIVELA_SOURCE_DIR, plan_.folder.string(), kDomain);
}

void Stack::start_witness(Witness& witness, const char* name, int network) {
  witness.process.reset();
  witness.words = std::make_unique<LinePipe>();
  ProcessPlan plan = foreign_plan(plan_, "fault_witness");
  plan.says = plan_.folder / fmt::format("{}.txt", name);
  plan.network = network;
  plan.output = witness.words->write_end();
  witness.process = std::make_unique<NodeProcess>(plan);
  witness.words->close_write_end();
}

/// What the simulator's referee says comes to ours alone, which says it again.
void Stack::start_referee() {
  const std::size_t place = node_index("referee");
  referee_words_ = std::make_unique<LinePipe>();
  ProcessPlan plan = foreign_plan(plan_, "fault_referee");
  plan.says = plan_.folder / "referee.txt";
  plan.network = network(place);
  plan.output = referee_words_->write_end();
  nodes_[place].reset();
  nodes_[place] = std::make_unique<NodeProcess>(plan);
  referee_words_->close_write_end();
}

ProcessPlan Stack::plan_of(std::size_t node) {
  ProcessPlan plan;
  plan.program = plan_.programs / fmt::format("trivela-{}", kNodes[node]);
  plan.arguments = {"--config", (plan_.folder / "nodes.toml").string()};
  plan.says = plan_.folder / fmt::format("{}.txt", kNodes[node]);
  plan.network = network(node);
  return plan;
}

void Stack::start(std::size_t node) {
  if (!has(node)) return;
  if (kNodes[node] == "referee") return start_referee();
  ProcessPlan plan = plan_of(node);
  if (kNodes[node] == "simulator")
    plan.arguments.insert(plan.arguments.end(),
                          {"--set", fmt::format("simulator.seed={}", plan_.seed % 100000 * 1000 + ++simulators_)});
  nodes_[node].reset();
  nodes_[node] = std::make_unique<NodeProcess>(plan);
}

void Stack::start_all() {
  for (std::size_t node = 0; node < kNodes.size(); ++node) start(node);
}

void Stack::stop_all() {
  for (std::size_t place = kNodes.size(); place-- > 0;) {
    if (!running(place)) continue;
    node(place).signal(SIGCONT);
    node(place).signal(SIGTERM);
    listen(kGrace, [&] { return node(place).ended(); });
  }
}

std::unique_ptr<NodeProcess> Stack::twin(std::size_t node) {
  ProcessPlan plan = plan_of(node);
  plan.says = plan_.folder / fmt::format("{}_twin.txt", kNodes[node]);
  return std::make_unique<NodeProcess>(plan);
}

void Stack::insist(Insists who) { client_->tell(static_cast<int>(who)); }

void Stack::disturb(const Fault& fault) {
  if (!hub_) return;
  Ways ways;
  for (std::size_t other = 0; other < kNodes.size(); ++other) {
    if (other == fault.node || (fault.other && *fault.other != other)) continue;
    ways[{fault.node, other}] = ways[{other, fault.node}] = fault.way;
  }
  hub_->set(std::move(ways));
}

std::vector<GarbledFrame> Stack::garbled_to_driver() const {
  return hub_ ? hub_->garbled() : std::vector<GarbledFrame>{};
}

void Stack::sound() {
  if (hub_) hub_->set({});
}

void Stack::receive(Witness& witness) {
  if (!witness.words->receive([&](const std::string& line) { witness.testimony.note(line); }))
    throw std::runtime_error{"a witness is gone"};
}

void Stack::hear_referee() {
  if (!referee_words_) return;
  constexpr std::string_view kWriter = "writer ";
  referee_words_->receive([&](const std::string& line) {
    const auto writer =
        line.starts_with(kWriter) ? guid_of(std::string_view{line}.substr(kWriter.size())) : std::nullopt;
    if (!writer) throw std::runtime_error{fmt::format("the referee says \"{}\"", line)};
    hub_->confine(*writer, node_index("referee"));
  });
}

bool Stack::listen(std::chrono::nanoseconds timeout, const std::function<bool()>& done) {
  const auto deadline = Clock::now() + timeout;
  for (;;) {
    receive(device_);
    receive(wire_);
    hear_referee();
    if (done()) return true;
    const auto left = deadline - Clock::now();
    if (left <= left.zero()) return false;
    std::array<pollfd, 3> sources{pollfd{device_.words->file_descriptor(), POLLIN, 0},
                                  pollfd{wire_.words->file_descriptor(), POLLIN, 0},
                                  pollfd{referee_words_ ? referee_words_->file_descriptor() : -1, POLLIN, 0}};
    if (referee_words_ && !running(node_index("referee"))) sources[2].fd = -1;  // it would be readable for ever
    const auto wait = std::min<std::chrono::nanoseconds>(left, kPollInterval);
    poll(sources.data(), sources.size(), static_cast<int>(std::chrono::ceil<std::chrono::milliseconds>(wait).count()));
  }
}

std::vector<fs::path> Stack::logs() const {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator{plan_.folder}) {
    if (entry.path().extension() == ".db") found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::optional<fs::file_time_type> Stack::log_changed() const {
  std::optional<fs::file_time_type> last;
  for (const fs::path& log : logs()) {
    for (const char* ending : {"", "-wal"}) {
      std::error_code none;
      const auto changed = fs::last_write_time(log.string() + ending, none);
      if (!none && (!last || changed > *last)) last = changed;
    }
  }
  return last;
}

}  // namespace trivela::faults
