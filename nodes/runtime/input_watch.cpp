#include "nodes/runtime/input_watch.hpp"

#include <algorithm>

#include "kicking/geometry/time.hpp"

namespace trivela::nodes {
namespace {

constexpr std::int64_t kStep_ns = 20'000'000;
constexpr std::int64_t kLongestPause_ns = 5 * kStep_ns;
constexpr std::int64_t kUnheard_ns = 5'000'000'000;   // after the start
constexpr std::int64_t kStoodStill_ns = 500'000'000;  // beyond this it is worth a line
constexpr double kDevicePeriod_s = 0.02;              // of one that is slower the cycle is, too
constexpr std::string_view kDevice = "device:";

}  // namespace

InputWatch::InputWatch(const NodeContext& context, bus::Node& node) : context_(context), watch_(kStep_ns) {
  if (context.settings.run.lockstep) return;
  for (const bus::Input& input : node.inputs()) add(input);
  if (inputs_.empty()) return;
  node.when_due(std::chrono::nanoseconds{kStep_ns}, "silence", [this] {
    const std::int64_t instant_ns = now_ns(std::chrono::steady_clock::now());
    look(instant_ns);
    return std::chrono::nanoseconds{watch_.pause_ns(kLongestPause_ns)};
  });
}

void InputWatch::add(const bus::Input& input) {
  const bool device = input.name.starts_with(kDevice);
  if (!device && input.period_s <= 0.0) return;
  const std::string name = device ? input.name.substr(kDevice.size()) : input.name;
  const auto known = std::ranges::find(inputs_, name, &Watched::name);
  if (known != inputs_.end()) {
    known->received_ns.push_back(input.received_ns);
    return;
  }
  const double period_s = std::max(device ? kDevicePeriod_s : input.period_s, context_.settings.run.cycle_s);
  const auto period_ns = kicking::nanoseconds(period_s);
  inputs_.push_back({name, watch_.add(period_ns), period_ns, {input.received_ns}});
}

void InputWatch::look(std::int64_t now_ns) {
  if (!started_ns_) started_ns_ = looked_ns_ = now_ns;
  if (now_ns - *looked_ns_ > kStoodStill_ns)
    context_.logger->warn("this process stood still for {:.2f} s", kicking::seconds(now_ns - *looked_ns_));
  looked_ns_ = now_ns;
  const std::uint8_t robot_id = context_.robot_id();
  for (Watched& input : inputs_) {
    std::int64_t received_ns = 0;
    for (const auto& way : input.received_ns) received_ns = std::max(received_ns, way(now_ns - input.period_ns));
    if (received_ns == input.last_ns) continue;
    watch_.received(input.stream, robot_id, received_ns, received_ns);
    input.last_ns = received_ns;
  }
  for (const robot::SilenceEdge& edge : watch_.look(now_ns)) lines_.note(edge, inputs_[edge.stream].name);
  for (const std::string& line : lines_.due(now_ns)) context_.logger->warn("{}", line);
  look_for_the_unheard(now_ns);
}

void InputWatch::look_for_the_unheard(std::int64_t now_ns) {
  if (silence_reported_ || now_ns - *started_ns_ < kUnheard_ns) return;
  silence_reported_ = true;
  for (const Watched& input : inputs_)
    if (input.last_ns == 0)
      context_.logger->warn("{} not received yet, {} s after the start", input.name, kUnheard_ns / 1'000'000'000);
}

}  // namespace trivela::nodes
