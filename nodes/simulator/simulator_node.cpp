#include "nodes/simulator/simulator_node.hpp"

#include <fmt/core.h>
#include <poll.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>
#include <type_traits>

#include "bus/renewal.hpp"
#include "config/field.hpp"
#include "config/scenario/scenario.hpp"
#include "emulators/sim/sim_messages.hpp"
#include "nodes/runtime/node_main.hpp"
#include "nodes/runtime/readers.hpp"
#include "sim/laser/laser.hpp"

namespace trivela::nodes {
namespace {

sim::Match match_of(const sim::Scenario& scenario, const config::Simulator& settings) {
  return sim::Match{scenario,
                    static_cast<std::uint64_t>(settings.seed),
                    static_cast<int>(settings.halves),
                    config::half_minutes(settings, scenario),
                    settings.max_possessions,
                    settings.paired_halves};
}

}  // namespace

sim::Scenario scenario_of(const config::Settings& settings) {
  sim::Scenario scenario = config::load_scenario(settings.run.scenario);
  if (scenario.cycle_s != settings.run.cycle_s) {
    throw std::runtime_error{fmt::format("{}: cycle_s = {} differs from run.cycle_s = {}", settings.run.scenario,
                                         scenario.cycle_s, settings.run.cycle_s)};
  }
  if (scenario.team.robots > 1.0) {
    throw std::runtime_error{
        fmt::format("{}: team.robots = {}, but one set of nodes is one robot: trivela simulate plays teams",
                    settings.run.scenario, scenario.team.robots)};
  }
  if (const auto difference = config::field_difference(scenario, settings))
    throw std::runtime_error{fmt::format("{}: {}", settings.run.scenario, *difference)};
  const config::ScanRecorder& scans = settings.scan_recorder;
  if (scans.enabled && std::holds_alternative<config::SimDevice>(scans.device) && !scenario.laser.enabled) {
    throw std::runtime_error{
        fmt::format("scan_recorder is enabled, but {} has no laser: laser.enabled = false", settings.run.scenario)};
  }
  return scenario;
}

SimulatorNode::SimulatorNode(NodeContext& context, EmulatedDevices* devices)
    : context_(context),
      devices_(devices),
      scenario_(scenario_of(context.settings)),
      match_(match_of(scenario_, context.settings.simulator)),
      wheels_(context.participant, {.owner = fmt::format("simulator/{}", context.robot_id())}),
      vision_(context.participant),
      flight_(context.participant),
      kick_truth_(context.participant),
      possession_truth_(context.participant),
      referee_repeats_(kicking::nanoseconds(context.settings.refbox.period_s)),
      drive_(context.participant, context.robot_id()),
      fire_(context.participant),
      charge_(context.participant, context.robot_id()),
      barrier_(context.participant, context.robot_id()) {
  if (scenario_.laser.enabled) scan_.emplace(context.participant);
  if (devices_ != nullptr && devices_->has_board()) {
    receipts_.emplace(context.participant);
  } else {
    kicker_.emplace(context.participant);
  }
  if (!context.settings.simulator.referee && context.settings.run.lockstep)
    throw std::runtime_error{
        "simulator.referee = false: in lockstep nobody else writes the referee's command of a cycle"};
  if (devices_ == nullptr && context.settings.simulator.referee)
    referee_.emplace(context.participant, referee_of(context.robot_id()));
  refuse_twins();
}

void SimulatorNode::refuse_twins() {
  const std::uint32_t domain_id = context_.settings.domain.domain_id;
  if (wheels_.other_writer_exists()) {
    throw std::runtime_error{fmt::format("another simulator of robot {} runs in domain {}: stop it first",
                                         context_.settings.run.robot_id, domain_id)};
  }
  if (referee_ && referee_->other_writer_exists()) {
    throw std::runtime_error{fmt::format("a referee of robot {} writes referee in domain {} already: stop it first",
                                         context_.settings.run.robot_id, domain_id)};
  }
}

void SimulatorNode::run() {
  if (devices_ != nullptr) say_settings();
  play();
  if (devices_ == nullptr) return;
  devices_->say_over();
  for (; !context_.stop.requested(); context_.idle(std::chrono::milliseconds(100))) context_.alive();
}

/// On standard output, before the first line of progress.
void SimulatorNode::say_settings() {
  for (const std::string& line : devices_->settings()) fmt::print("{}\n", line);
  report_progress();
}

void SimulatorNode::play() {
  if ((context_.settings.run.lockstep || devices_ != nullptr) && !nodes_are_here()) return;
  if (!context_.settings.run.lockstep) started_ns_ = context_.steady_ns();
  while (!match_.done()) {
    context_.alive();
    const sim::Sensors sensors = match_.sense();
    t_ns_ = sensors.t_ns;
    ++cycle_;
    publish(sensors);
    if (!await_cycle(t_ns_)) return;
    const auto orders = commands(t_ns_);
    if (!orders) return;
    publish_truth(match_.step(*orders));
    report_progress();
  }
}

bool SimulatorNode::nodes_are_here() {
  const bus::Stop& stop = context_.stop;
  const bool scans = scan_ && context_.settings.scan_recorder.enabled;
  const auto received = [this](const auto&... outputs) { return (readers_before_stop(context_, outputs) && ...); };
  const auto driver = [this](auto timeout) { return fire_.wait_for_writers(1, timeout); };
  return (!scans || received(*scan_)) && received(vision_, flight_, kick_truth_, possession_truth_) &&
         (has_drives() || received(wheels_)) && (!referee_ || received(*referee_)) &&
         (!kicker_ || (received(*kicker_) && ready_before_stop(stop, driver, "no kicker_driver is there"))) &&
         (devices_ == nullptr || devices_->wait_for_nodes(stop));
}

namespace {

/// Is the field an instant of the world, by its name?
constexpr bool is_instant(std::string_view name) {
  return name == "t_ns" || name.ends_with("_t_ns") || name == "t_exposure_ns";
}

/// Has the message no other time, such as a duration, which no start would shift?
template <class T>
constexpr bool has_instants_alone() {
  return std::ranges::all_of(bus::meta<T>::fields, [](const bus::Field& field) {
    return !field.name.ends_with("_ns") || is_instant(field.name);
  });
}

}  // namespace

template <class T>
void SimulatorNode::write(bus::Writer<T>& writer, T message, std::uint64_t seq) {
  static_assert(has_instants_alone<T>());
  message.robot_id = context_.robot_id();
  message.seq = seq;
  bus::visit_fields(message, [this](std::string_view name, std::string_view, auto& field) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(field)>, std::int64_t>) {
      if (is_instant(name)) field += started_ns_;
    }
  });
  writer.write(message);
}

void SimulatorNode::publish(const sim::Sensors& sensors) {
  if (devices_ != nullptr) devices_->show(sensors);
  publish_referee(sensors);
  if (kicker_) write(*kicker_, hal::kicker_message(sensors), cycle_);
  write(vision_, hal::vision_message(t_ns_, sensors.vision), cycle_);
  write(flight_, hal::flight_message(t_ns_, sensors.flight), cycle_);
  if (!has_drives()) write(wheels_, hal::wheels_message(sensors), cycle_);
  publish_scans(sensors);
}

/// In lockstep in each cycle, since the nodes wait for it.
void SimulatorNode::publish_referee(const sim::Sensors& sensors) {
  if (!referee_) return;
  const msg::Referee word = hal::referee_message(t_ns_, sensors.referee);
  if (context_.settings.run.lockstep || referee_repeats_.due(word)) write(*referee_, word, ++referee_words_);
}

void SimulatorNode::publish_scans(const sim::Sensors& sensors) {
  if (!scan_) return;
  for (const kicking::lob::Scan& scan : sensors.scans) {
    write(*scan_, hal::scan_message(scan, sim::laser_model(scenario_.laser).geometry), ++scans_);
    if (context_.settings.scan_recorder.enabled) barrier_.expect_scan(scan.t_ns);
  }
}

bool SimulatorNode::await_cycle(std::int64_t t_ns) {
  if (!context_.settings.run.lockstep) return wait_until(started_ns_ + t_ns + context_.cycle().count());
  if (!barrier_.wait_for(t_ns, context_.stop)) return false;
  const double pace = context_.settings.simulator.pace;
  if (pace <= 0.0) return true;
  if (!wait_until(next_ns_)) return false;
  // What the nodes took longer for is not caught up with: nobody could follow.
  next_ns_ = std::max(next_ns_ + kicking::nanoseconds(context_.settings.run.cycle_s / pace), context_.steady_ns());
  return true;
}

/// On the steady clock; false: the stop was requested.
bool SimulatorNode::wait_until(std::int64_t until_ns) const {
  pollfd stop{context_.stop.file_descriptor(), POLLIN, 0};
  const std::int64_t left_ns = until_ns - context_.steady_ns();
  timespec timeout{};
  if (left_ns > 0) timeout = {left_ns / 1'000'000'000, left_ns % 1'000'000'000};
  ppoll(&stop, 1, &timeout, nullptr);
  return !context_.stop.requested();
}

std::optional<sim::Commands> SimulatorNode::commands(std::int64_t t_ns) {
  sim::Commands out;
  if (kicker_) bus::renew_if_silent(fire_);
  if (!has_drives()) drive_.keep_hearing();
  const auto take_fires = [&] {
    fire_.take([&](const msg::DeviceFire& fire, const bus::SampleInfo& info) {
      if (fire.robot_id != context_.robot_id()) return;
      if (fire.withdrawn || is_of_the_driver(fire, info)) order(fire, out);
    });
    return fires_ >= barrier_.fires();
  };
  std::optional<msg::DeviceDrive> drive;
  if (context_.settings.run.lockstep) {
    const auto driven = [&](auto timeout) { return (drive = drive_.await(t_ns, timeout)).has_value(); };
    const auto fired = [&](auto timeout) { return take_fires() || (fire_.wait(timeout) && take_fires()); };
    if (!ready_before_stop(context_.stop, driven, "no drive command has reached the simulator") ||
        !ready_before_stop(context_.stop, fired, "a kick has not reached the simulator"))
      return std::nullopt;
    out.lever_kind = barrier_.lever_kind();
  } else {
    drive = fresh_drive();
    out.lever_kind = wanted_lever_kind();
    take_fires();
    take_pulses(out);
  }
  if (has_drives()) out.drive = devices_->set_point();
  if (drive) out.drive = {drive->vx_mps, drive->vy_mps, drive->omega_radps};
  return out;
}

/// As a bridge of a real coil has to: it obeys one driver, and nobody where two have its name.
bool SimulatorNode::is_of_the_driver(const msg::DeviceFire& fire, const bus::SampleInfo& info) {
  const std::string driver = bus::owner_of_robot("kicker_driver", context_.robot_id());
  if (info.owner == driver && (context_.settings.run.lockstep || fire_.writers_of(driver) == 1)) return true;
  context_.logger->warn(
      "kick {} by device/fire of {}: not fired", fire.kick_id,
      info.owner == driver ? "several programs that call themselves " + driver : "another program than " + driver);
  return false;
}

/// What the simulated kicker does with the driver's word.
void SimulatorNode::order(const msg::DeviceFire& fire, sim::Commands& out) {
  constexpr double kLate_s = 0.05;
  if (fire.withdrawn) {
    if (out.fire && out.fire->kick_id == fire.kick_id) out.fire.reset();
    return;
  }
  ++fires_;
  const std::int64_t fire_t_ns = fire.t_ns - started_ns_;
  const double late_s = kicking::seconds(t_ns_ - fire_t_ns);
  if (!context_.settings.run.lockstep && late_s > kLate_s) {
    context_.logger->warn("kick {} reached the coil {:.3f} s after its instant: not fired", fire.kick_id, late_s);
    return;
  }
  if (scenario_.kicker.flat.enabled && match_.true_state().lever_kind != fire.kick_kind) {
    context_.logger->warn("kick {}: the lever does not stand for its kind of kick: not fired", fire.kick_id);
    return;
  }
  out.fire = sim::Fire{fire_t_ns, fire.kick_id, fire.power};
}

/// A pulse stands for its kick until the kick's receipt is looked for, which may come after it.
void SimulatorNode::take_pulses(sim::Commands& out) {
  if (!receipts_) return;
  for (const hal::CoilPulse& pulse : devices_->take_pulses())
    out.fire = sim::Fire{pulse.t_ns - started_ns_, pulse.t_ns, pulse.power};
}

std::int64_t SimulatorNode::kick_of_pulse(std::int64_t t_ns) {
  bus::renew_if_silent(*receipts_);
  receipts_->take([this](const msg::KickReceipt& receipt) {
    if (receipt.robot_id == context_.robot_id() && msg::begins_kick(receipt))
      recent_.accepted(receipt.kick_id, receipt.fired_t_ns);
  });
  const auto kick_id = recent_.take(t_ns);
  if (!kick_id) context_.logger->error("no receipt for the pulse at {} ns", t_ns);
  return kick_id.value_or(0);
}

std::optional<msg::DeviceDrive> SimulatorNode::fresh_drive() {
  const auto drive = drive_.latest();
  const bool fresh =
      drive && kicking::seconds(started_ns_ + t_ns_ - drive->t_ns) <= context_.settings.odometry.drive_timeout_s;
  return fresh ? drive : std::nullopt;
}

/// By the board, or as the driver says on device/charge.
std::uint8_t SimulatorNode::wanted_lever_kind() {
  if (devices_ != nullptr && devices_->has_board()) return devices_->lever_kind();
  charge_.keep_hearing();
  const auto word = charge_.latest();
  return word ? word->lever_kind : std::uint8_t{0};
}

void SimulatorNode::publish_truth(const sim::StepEvents& events) {
  for (const sim::KickTruth& kick : events.kicks) {
    msg::KickTruth truth = hal::truth_message(kick);
    if (receipts_) truth.kick_id = kick_of_pulse(kick.kick_id);
    write(kick_truth_, truth, ++kicks_);
  }
  for (const sim::PossessionTruth& end : events.possessions)
    write(possession_truth_, hal::possession_message(end), ++possessions_);
}

void SimulatorNode::report_progress() {
  const double total_s =
      context_.settings.simulator.halves * config::half_minutes(context_.settings.simulator, scenario_) * 60.0;
  progress_.say(played_s(), total_s, match_.done());
}

int simulator_main(int argc, char** argv) {
  std::optional<EmulatedDevices> devices;  // where the node joins the bus again they stay where its nodes look for them
  return node_main(argc, argv, "simulator", [&devices](NodeContext& context) {
    const bool emulated = context.settings.simulator.devices == config::SimulatedDevices::kEmulated;
    if (emulated && !devices) {
      config::Settings settings = context.settings;
      settings.hal = config::hal_for(settings.hal, context.robot);
      devices.emplace(settings, context.robot.base, context.logger);
    }
    SimulatorNode node{context, devices ? &*devices : nullptr};
    node.run();
    context.logger->info("played {:.1f} s", node.played_s());
  });
}

}  // namespace trivela::nodes
