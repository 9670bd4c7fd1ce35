#include "nodes/kicker_driver/kicker_driver_node.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hal/open.hpp"
#include "kicking/geometry/time.hpp"
#include "nodes/runtime/lockstep.hpp"
#include "nodes/runtime/node_main.hpp"
#include "nodes/runtime/readers.hpp"

namespace trivela::nodes {
namespace {

/// A robot has one decision node, or the two that it is configured for.
std::vector<std::string> decision_owners(const NodeContext& context) {
  std::vector<std::string> owners{bus::owner_of_robot(kDecisionNode, context.robot_id())};
  if (context.settings.kick_decision.standby)
    owners.push_back(bus::owner_of_robot(kSecondDecisionNode, context.robot_id()));
  return owners;
}

}  // namespace

KickerDriverNode::KickerDriverNode(NodeContext& context, std::unique_ptr<hal::Kicker> kicker)
    : context_(context),
      kicker_(std::move(kicker)),
      controller_(context.settings.kicker_driver, context.settings.run.cycle_s, context.robot.model, context.robot_id(),
                  context.settings.run.lockstep ? robot::DecisionNode::kThere : robot::DecisionNode::kUnheard),
      own_decisions_(decision_owners(context)),
      node_(context.participant, "kicker_driver", context.robot_id()),
      status_out_(node_.writer<msg::KickerStatus>()),
      receipt_out_(node_.writer<msg::KickReceipt>()),
      emulation_(context, node_),
      step_done_(step_done_writer(context, node_)),
      referee_(context.settings.run.referee_timeout_s),
      first_(context.settings.run.lockstep) {
  demand_pulses();
  reject_duplicate_node(context_, receipt_out_, "kicker_driver");
  if (!context_.settings.run.lockstep) begin_in_real_time();
  node_.on_device(
      "kicker",
      [this](std::chrono::nanoseconds timeout) {
        auto sample = kicker_->read(timeout);
        if (!sample) tell_charge();
        return sample;
      },
      [this](const hal::KickerSample& sample) { on_sample(sample); },
      bus::writes<msg::KickerStatus, msg::KickReceipt, msg::DeviceFire, msg::DeviceCharge, msg::DeviceEmulated,
                  msg::StepDone>());
  node_.on<msg::DriveCommand>(
      [this](const msg::DriveCommand& drive, const bus::SampleInfo& info) { on_drive(drive, info); });
  bus::ReaderOptions orders, words;
  if (context_.settings.run.lockstep) {
    // The word of a cycle comes with its sample, when no order's instant lies ahead; a cycle takes as long as it takes.
    referee_of_cycle_ = node_.stores<msg::Referee>();
  } else {
    words.on_liveliness = [this](const bus::Liveliness& writers) { referee_.writers(writers.alive); };
    node_.on<msg::Referee>([this](const msg::Referee& word, const bus::SampleInfo& info) { on_referee(word, info); },
                           bus::writes<msg::KickReceipt, msg::DeviceFire, msg::DeviceCharge>(), words);
    node_.on<msg::WorldState>([this](const msg::WorldState& world) { on_world(world); },
                              bus::writes<msg::KickReceipt, msg::DeviceFire, msg::DeviceCharge>(), {.observer = true});
    orders.on_liveliness = [this](const bus::Liveliness& writers) {
      if (loop_.fell_silent(writers.alive, writers.lapsed, context_.steady_ns()))
        context_.logger->warn("the decision loop is silent: no order comes");
    };
  }
  node_.on<msg::KickOrder>(
      [this](const msg::KickOrder& order, const bus::SampleInfo& info) {
        on_order(order, by_own_decision(info) ? robot::OrderBy::kOwnDecision : robot::OrderBy::kUnauthorised);
      },
      bus::writes<msg::KickReceipt, msg::DeviceFire, msg::DeviceCharge, msg::StepDone>(), orders);
}

void KickerDriverNode::begin_in_real_time() {
  controller_.began(context_.steady_ns());
  pending_.emplace(PendingKick::name_of(context_.settings.domain, context_.robot_id()));
  if (!pending_->why().empty())
    context_.logger->warn("a kick that is lost with this program will not be reported: {}", pending_->why());
  kicker_->hold_when([this](std::int64_t judged_ns) { return holds(judged_ns); });
  kicker_->call_when_written([this] { pending_->settled(); });
  node_.on_stop([this] {
    const std::lock_guard lock{mutex_};
    stop();
    take_results();
  });
}

/// The steady clock, which samples and orders are of in real time: it goes on while this process stands still.
std::int64_t KickerDriverNode::now_t_ns() const {
  return context_.settings.run.lockstep ? sample_t_ns_ : context_.steady_ns();
}

void KickerDriverNode::on_sample(const hal::KickerSample& sample) {
  first_.once([this] {
    expect_device(*kicker_);
    expect_readers(context_, status_out_);
    expect_readers(context_, receipt_out_);
  });
  demand_capabilities();
  if (sample.fault != hal::KickerFault::kLink) demand_lever();
  std::optional<msg::Referee> word;
  if (referee_of_cycle_) word = input_of_cycle(context_, *referee_of_cycle_, sample.t_ns);
  const std::lock_guard lock{mutex_};
  sample_t_ns_ = sample.t_ns;
  emulation_.see(msg::PART_KICKER, sample.emulated, sample.t_ns);
  check_clock(sample);
  say_link(sample.fault == hal::KickerFault::kLink);
  const msg::KickerStatus status = controller_.status(sample, referee_permission(word), now_t_ns());
  look_for_decision();
  kicker_->charge(controller_.charge_command());  // before anybody hears of the state that it belongs to
  status_out_.write(status);
  withdraw();
  take_results();
  report_done(sample.t_ns);
}

KickerDriverNode::~KickerDriverNode() {
  try {
    if (!context_.settings.run.lockstep) take_results();
    kicker_->charge(controller_.end());
    kicker_->make_safe();  // from here on it does not ask this node any more
  } catch (const std::exception& error) {
    context_.logger->error("the board does not take the command to empty: {}", error.what());
  }
}

/// The device says with its samples what it can do: a bridge that is replaced may be able to do less.
void KickerDriverNode::demand_capabilities() const {
  const std::string lacking = robot::missing(context_.settings.kicker_driver.demand, kicker_->capabilities());
  if (lacking.empty()) return;
  throw std::runtime_error{fmt::format("kicker_driver.demand: the kicker \"{}\" has no {}",
                                       config::text_of(context_.settings.hal.kicker), lacking)};
}

/// A robot of several kinds of kick needs a lever that its driver can move.
void KickerDriverNode::demand_lever() const {
  if (context_.robot.model.kinds() == 1 || kicker_->capabilities().lever) return;
  throw std::runtime_error{fmt::format("robot {} has {} kinds of kick, but the kicker \"{}\" has no lever",
                                       context_.robot.name, context_.robot.model.kinds(),
                                       config::text_of(context_.settings.hal.kicker))};
}

/// A set-point of the robot's table that the device has no pulse for would be a kick that is accepted and never fired.
void KickerDriverNode::demand_pulses() const {
  for (std::size_t kind = 0; kind < context_.robot.model.kinds(); ++kind) {
    const auto& table = context_.robot.model.kind(kind).table;
    for (const double power : {table.front().power, table.back().power}) {
      if (const std::string why = kicker_->beyond(power); !why.empty())
        throw std::runtime_error{fmt::format("the robot's table and the kicker \"{}\" do not fit: {}",
                                             config::text_of(context_.settings.hal.kicker), why)};
    }
  }
}

/// Where no sample comes the capacitor is spoken to all the same.
void KickerDriverNode::tell_charge() {
  if (context_.settings.run.lockstep) return;
  const std::lock_guard lock{mutex_};
  look_for_decision();
  kicker_->charge(controller_.charge_command());
  take_results();
}

/// A decision node that has gone takes the charge with it, and before it was heard there is none. It says `drive` every
/// cycle; that its writer of orders is
/// alive would be no sign: one that has lapsed once stays so until it orders again, and nobody orders of a driver that
/// is off.
void KickerDriverNode::look_for_decision() {
  if (context_.settings.run.lockstep) return;
  constexpr std::int64_t kLost_ns = 200'000'000;
  const std::int64_t received_ns = decision_received_ns_;
  robot::DecisionNode known = robot::DecisionNode::kUnheard;
  if (received_ns != 0) {
    const bool lost = context_.steady_ns() - received_ns > kLost_ns;
    known = lost ? robot::DecisionNode::kLost : robot::DecisionNode::kThere;
  }
  if (known == robot::DecisionNode::kLost && decision_ != known)
    context_.logger->warn("the decision node is gone: the capacitor is to be emptied");
  decision_ = known;
  controller_.decision_node(known, now_t_ns());
}

/// In lockstep the cycle's word; in real time the last one, for as long as it counts, and while the robot's own world
/// does not say that the game stands: a stop that was lost on the way to one of the two still stops.
robot::RefereePermission KickerDriverNode::referee_permission(const std::optional<msg::Referee>& word_of_cycle) {
  if (referee_of_cycle_)
    return word_of_cycle && word_of_cycle->playing ? robot::RefereePermission::kPlay : robot::RefereePermission::kStop;
  if (context_.stop.requested()) return robot::RefereePermission::kStop;  // this program ends
  const std::int64_t now_ns = now_t_ns();
  if (const auto news = referee_.news(now_ns)) context_.logger->warn(*news);
  const robot::RefereePermission says = referee_.says(now_ns);
  return says == robot::RefereePermission::kPlay && world_stands_ ? robot::RefereePermission::kStop : says;
}

/// A sample that is not of the steady clock would make every order stale without saying why.
void KickerDriverNode::check_clock(const hal::KickerSample& sample) {
  constexpr double kAnotherClock_s = 10.0;  // no stall of ours is as long
  const double off_s = kicking::seconds(now_t_ns() - sample.t_ns);
  const bool differs = !context_.settings.run.lockstep && std::abs(off_s) > kAnotherClock_s;
  if (differs && !clock_differs_)
    context_.logger->error("the kicker's samples are {:.0f} s off this machine's steady clock: nothing will be fired",
                           off_s);
  clock_differs_ = differs;
}

/// What the device says of its link and of kicks that it dropped, whenever that is something else.
void KickerDriverNode::say_link(bool lost) {
  std::string said = kicker_->status();
  if (said == link_said_) return;
  link_said_ = std::move(said);
  if (!link_said_.empty()) context_.logger->log(lost ? spdlog::level::warn : spdlog::level::info, "{}", link_said_);
}

void KickerDriverNode::on_referee(const msg::Referee& word, const bus::SampleInfo& info) {
  if (!word.playing) called_off_ns_ = now_t_ns();  // before it waits for anybody
  const std::lock_guard lock{mutex_};
  referee_.received(word, now_t_ns(), info.writer);
  if (!word.playing) stop();
}

void KickerDriverNode::on_world(const msg::WorldState& world) {
  if (!world.playing) called_off_ns_ = now_t_ns();
  const std::lock_guard lock{mutex_};
  world_stands_ = !world.playing;
  if (world_stands_) stop();
}

void KickerDriverNode::stop() {
  controller_.referee(robot::RefereePermission::kStop);
  withdraw();
}

/// Calls a kick off that the device has been told of but has not done yet.
void KickerDriverNode::withdraw() {
  const auto receipt = controller_.withdrawal(now_t_ns());
  if (!receipt) return;
  kicker_->withdraw(receipt->kick_id);
  context_.logger->warn("kick {} called off: {}", receipt->kick_id, bus::label(receipt->refusal));
  receipt_out_.write(*receipt);
  if (pending_) pending_->settled();
}

/// Asked by whoever writes to the device, immediately before.
bool KickerDriverNode::holds(std::int64_t judged_ns) {
  if (judged_ns <= called_off_ns_ || context_.stop.requested()) return true;
  pending_->being_told();
  return false;
}

/// What the predecessor accepted and did not settle, once somebody hears it.
void KickerDriverNode::complete_predecessor() {
  if (!pending_ || !pending_->left() || receipt_out_.readers() == 0) return;
  const PendingKick::Left& left = *pending_->left();
  context_.logger->warn(
      "kick {} was accepted by a driver that ended {}", left.receipt.kick_id,
      left.being_told ? "while it wrote to the device: whether it fired is not known" : "before it fired");
  receipt_out_.write(left.being_told ? controller_.not_known(left.receipt, now_t_ns())
                                     : controller_.not_fired(left.receipt, now_t_ns()));
  pending_->forget();
  pending_->settled();
}

/// A shot that the device was not told of is no kick: a second receipt says so.
void KickerDriverNode::take_results() {
  complete_predecessor();
  while (const auto result = kicker_->take_result()) {
    const auto receipt = controller_.result(*result, now_t_ns());
    if (!receipt) continue;
    context_.logger->warn("kick {} was not fired: {}", receipt->kick_id, bus::label(receipt->refusal));
    receipt_out_.write(*receipt);
    pending_->settled();
  }
}

/// Two programs in the decision node's name: nobody can tell whose orders are the robot's, and none is fired.
void KickerDriverNode::on_drive(const msg::DriveCommand& drive, const bus::SampleInfo& info) {
  if (!owns_decisions(info)) return;
  receive_drive(info);
  const std::lock_guard lock{mutex_};
  // A lever that began to move under an accepted order would make another kick of it.
  if (decision_received_ns_ != 0 && !controller_.firing()) kicker_->lever(drive.lever_kind);
}

void KickerDriverNode::receive_drive(const bus::SampleInfo& info) {
  const std::int64_t now_ns = context_.steady_ns();
  const std::lock_guard lock{drives_mutex_};
  bus::WriterWatch& drives = drives_.try_emplace(std::string(info.owner)).first->second;
  if (drives.see(info.member, now_ns))
    context_.logger->warn("several programs write drive as {}: nothing is fired; stop all but one", info.owner);
  decision_received_ns_ = drives.contested(now_ns) ? 0 : now_ns;
}

/// The name is what an order is known by. One of another program than that whose drive commands are heard is named.
bool KickerDriverNode::by_own_decision(const bus::SampleInfo& info) {
  if (!owns_decisions(info)) return false;
  const std::lock_guard lock{drives_mutex_};
  const auto drives = drives_.find(info.owner);
  const bool another =
      !context_.settings.run.lockstep && drives != drives_.end() && drives->second.last() != info.member;
  if (std::exchange(other_orders_, another) != another && another)
    context_.logger->warn("another program than the one that drives writes kick_order as {}", info.owner);
  return true;
}

bool KickerDriverNode::owns_decisions(const bus::SampleInfo& info) const {
  return std::ranges::find(own_decisions_, info.owner) != own_decisions_.end();
}

/// Until when the coil may be energised: while the order is valid and not too old, whatever it says of itself, with a
/// cycle more for an instant that lies ahead, and while the referee's last word counts.
std::int64_t KickerDriverNode::deadline_ns(const msg::KickOrder& order) const {
  const double oldest_s = context_.settings.kicker_driver.max_order_age_s + context_.settings.run.cycle_s;
  const std::int64_t too_old_ns = std::max(order.t_ns, order.fire_t_ns) + kicking::nanoseconds(oldest_s);
  return std::min({order.valid_until_t_ns, too_old_ns, referee_.counts_until_ns()});
}

void KickerDriverNode::on_order(const msg::KickOrder& order, robot::OrderBy by) {
  const bool real_time = !context_.settings.run.lockstep;
  const std::int64_t received_ns = real_time ? context_.steady_ns() : 0;
  const std::lock_guard lock{mutex_};
  look_for_decision();
  if (real_time) controller_.referee(referee_permission({}));
  const std::int64_t judged_ns = now_t_ns();
  msg::KickReceipt receipt = controller_.answer(order, judged_ns, by);
  receipt.received_steady_ns = received_ns;
  if (receipt.accepted) {
    if (pending_) pending_->accepted(receipt);
    kicker_->lever(receipt.kick_kind);  // an earlier wish that the board has not heard yet is withdrawn
    kicker_->fire({.kick_id = receipt.kick_id,
                   .power = receipt.power,
                   .t_ns = receipt.fired_t_ns,
                   .until_ns = real_time ? deadline_ns(order) : hal::kNoDeadline_ns,
                   .judged_ns = judged_ns,
                   .kick_kind = receipt.kick_kind});
    if (real_time) receipt.fired_steady_ns = context_.steady_ns();
    context_.logger->info("kick {} fired with power {:.2f}", order.kick_id, order.power);
  } else {
    context_.logger->warn("kick {} refused: {}", order.kick_id, bus::label(receipt.refusal));
  }
  receipt_out_.write(receipt);
  report_done(sample_t_ns_);
}

void KickerDriverNode::report_done(std::int64_t t_ns) {
  step_done(step_done_, context_.robot_id(), msg::STEP_KICKER_DRIVER, t_ns, controller_.handled(), controller_.fires());
}

int kicker_driver_main(int argc, char** argv) {
  return node_main(argc, argv, "kicker_driver", [](NodeContext& context) {
    KickerDriverNode node{context, hal::open_kicker(config::hal_for(context.settings.hal, context.robot),
                                                    {context.participant, context.robot_id()})};
    run(context, node.node());
  });
}

}  // namespace trivela::nodes
