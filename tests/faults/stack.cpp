#include "tests/faults/stack.hpp"

#include <fcntl.h>
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
constexpr std::chrono::milliseconds kGlance{20};
constexpr std::chrono::seconds kGrace{10};

constexpr const char* kHostsXml = R"(<CycloneDDS xmlns="https://cdds.io/config"><Domain Id="any">
  <General><Interfaces><NetworkInterface name="tap0"/></Interfaces><AllowMulticast>true</AllowMulticast>
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
[simulator]
halves = 1
half_minutes = 1000.0
)";

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
  }
  const auto network = [&](std::size_t host) { return hosts_.empty() ? -1 : hosts_[host].network(); };
  start_witness(device_, "witness_device", network(node_index("kicker_driver")));
  start_witness(wire_, "witness_wire", network(kNodes.size()));
}

Stack::~Stack() {
  for (Witness* witness : {&device_, &wire_}) {
    for (const int descriptor : {witness->words, witness->leash}) {
      if (descriptor >= 0) close(descriptor);
    }
  }
}

void Stack::write_configuration() const {
  std::ofstream{plan_.folder / "cyclonedds.xml"}
      << (plan_.with_links ? std::string{kHostsXml} : fmt::format(kLoopbackXml, getpid()));
  std::ofstream{plan_.folder / "scenario.toml"} << kScenario;
  std::ofstream{plan_.folder / "nodes.toml"}
      << fmt::format(kSettings, TRIVELA_SOURCE_DIR, plan_.folder.string(), kDomain);
}

void Stack::start_witness(Witness& witness, const char* name, int network) {
  std::array<int, 2> words{}, leash{};
  if (pipe2(words.data(), O_CLOEXEC) != 0 || pipe2(leash.data(), O_CLOEXEC) != 0)
    throw std::runtime_error{"no pipe for a witness"};
  ProcessPlan plan;
  plan.program = plan_.witness;
  plan.arguments = {std::to_string(kDomain)};
  plan.environment = {{"CYCLONEDDS_URI", "file://" + (plan_.folder / "cyclonedds.xml").string()}};
  plan.says = plan_.folder / fmt::format("{}.txt", name);
  plan.network = network;
  plan.output = words[1];
  plan.input = leash[0];
  witness.process = std::make_unique<NodeProcess>(plan);
  close(words[1]);
  close(leash[0]);
  witness.words = words[0];
  witness.leash = leash[1];
  fcntl(witness.words, F_SETFL, O_NONBLOCK);
  fcntl(witness.words, F_SETPIPE_SZ, 1 << 20);
}

ProcessPlan Stack::plan_of(std::size_t node) {
  ProcessPlan plan;
  plan.program = plan_.programs / fmt::format("trivela-{}", kNodes[node]);
  plan.arguments = {"--config", (plan_.folder / "nodes.toml").string()};
  plan.says = plan_.folder / fmt::format("{}.txt", kNodes[node]);
  plan.network = hosts_.empty() ? -1 : hosts_[node].network();
  return plan;
}

void Stack::start(std::size_t node) {
  ProcessPlan plan = plan_of(node);
  if (kNodes[node] == "recorder") {
    const fs::path log = plan_.folder / fmt::format("match-{:04}.db", ++recorders_);
    plan.arguments.insert(plan.arguments.end(), {"--set", fmt::format("recorder.log=\"{}\"", log.string())});
  }
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
  if (kNodes[node] == "recorder") {
    const fs::path log = plan_.folder / fmt::format("match-{:04}.db", recorders_);
    plan.arguments.insert(plan.arguments.end(), {"--set", fmt::format("recorder.log=\"{}\"", log.string())});
  }
  plan.says = plan_.folder / fmt::format("{}_twin.txt", kNodes[node]);
  return std::make_unique<NodeProcess>(plan);
}

void Stack::disturb(const Fault& fault) {
  if (!hub_) return;
  Ways ways;
  for (std::size_t other = 0; other < kNodes.size(); ++other) {
    if (other == fault.node || (fault.other && *fault.other != other)) continue;
    ways[{fault.node, other}] = ways[{other, fault.node}] = fault.way;
  }
  hub_->set(std::move(ways));
}

void Stack::sound() {
  if (hub_) hub_->set({});
}

bool Stack::hear(Witness& witness) {
  std::array<char, 65536> buffer;
  bool heard = false;
  for (;;) {
    const ssize_t size = read(witness.words, buffer.data(), buffer.size());
    if (size == 0) throw std::runtime_error{"a witness is gone"};
    if (size < 0) return heard;
    heard = true;
    witness.rest.append(buffer.data(), static_cast<std::size_t>(size));
    std::size_t begin = 0;
    for (std::size_t end; (end = witness.rest.find('\n', begin)) != std::string::npos; begin = end + 1)
      witness.testimony.note(witness.rest.substr(begin, end - begin));
    witness.rest.erase(0, begin);
  }
}

bool Stack::listen(std::chrono::nanoseconds timeout, const std::function<bool()>& done) {
  const auto deadline = Clock::now() + timeout;
  for (;;) {
    hear(device_);
    hear(wire_);
    if (done()) return true;
    const auto left = deadline - Clock::now();
    if (left <= left.zero()) return false;
    std::array<pollfd, 2> sources{pollfd{device_.words, POLLIN, 0}, pollfd{wire_.words, POLLIN, 0}};
    const auto wait = std::min<std::chrono::nanoseconds>(left, kGlance);
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
  const fs::path log = plan_.folder / fmt::format("match-{:04}.db", recorders_);
  std::optional<fs::file_time_type> last;
  for (const char* ending : {"", "-wal"}) {
    std::error_code none;
    const auto changed = fs::last_write_time(log.string() + ending, none);
    if (!none && (!last || changed > *last)) last = changed;
  }
  return last;
}

}  // namespace trivela::faults
