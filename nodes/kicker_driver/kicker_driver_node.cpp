#include "nodes/kicker_driver/kicker_driver_node.hpp"

#include <algorithm>

#include "nodes/runtime/step_done.hpp"

namespace trivela::nodes {
namespace {

static_assert(int{msg::FAULT_NONE} == int(hal::KickerFault::kNone));
static_assert(int{msg::FAULT_LINK} == int(hal::KickerFault::kLink));

PowerRange power_range(const kicking::EffectiveTable& table) { return {table.front().power, table.back().power}; }

}  // namespace

KickerDriverNode::KickerDriverNode(NodeContext& context, std::unique_ptr<hal::Kicker> kicker)
    : context_(context),
      kicker_(std::move(kicker)),
      gate_(context.settings.kicker_driver, power_range(context.robot.model.table)),
      node_(context.participant, "kicker_driver", context.robot_id()),
      status_out_(node_.writer<msg::KickerStatus>()),
      receipt_out_(node_.writer<msg::KickReceipt>()),
      step_done_(step_done_writer(context, node_)),
      referee_(node_.stores<msg::Referee>()),
      first_(context.settings.run.lockstep) {
  refuse_twin(context_, receipt_out_, "kicker_driver");
  node_.on_device(
      "kicker",
      [this](std::chrono::nanoseconds timeout) {
        if (kicker_->ended()) context_.idle(timeout);
        return kicker_->read(timeout);
      },
      [this](const hal::KickerSample& sample) { on_sample(sample); }, bus::writes<msg::KickerStatus, msg::StepDone>());
  bus::ReaderOptions orders;
  // In lockstep a cycle takes as long as it takes.
  if (!context_.settings.run.lockstep)
    orders.on_liveliness = [logger = context_.logger](const bus::Liveliness& writers) {
      if (writers.alive == 0 && writers.lapsed > 0) logger->warn("the decision loop is silent: no order comes");
    };
  node_.on<msg::KickOrder>([this](const msg::KickOrder& order) { on_order(order); },
                           bus::writes<msg::KickReceipt, msg::SimFire, msg::StepDone>(), orders);
}

/// The clock of the device's samples; between two of them real time goes on, but not in lockstep.
std::int64_t KickerDriverNode::now_t_ns() const {
  if (context_.settings.run.lockstep) return sample_t_ns_;
  return sample_t_ns_ + std::chrono::nanoseconds{std::chrono::steady_clock::now() - sampled_}.count();
}

void KickerDriverNode::on_sample(const hal::KickerSample& sample) {
  first_.once([this] {
    expect_device(*kicker_);
    expect_readers(status_out_, 2);  // kick_decision, recorder
    const bool scans = context_.settings.scan_recorder.enabled;
    expect_readers(receipt_out_, scans ? 3 : 2);  // shot_observer, recorder, scan_recorder
  });
  const auto referee = input_of_cycle(context_, *referee_, sample.t_ns);
  const std::lock_guard lock{mutex_};
  sample_t_ns_ = sample.t_ns;
  sampled_ = std::chrono::steady_clock::now();
  gate_.device(sample);
  gate_.playing(referee && referee->playing);
  msg::KickerStatus out{};
  out.robot_id = context_.robot_id();
  out.seq = ++statuses_;
  out.t_ns = sample.t_ns;
  out.charge = sample.charge;
  out.armed = gate_.armed();
  out.ready = gate_.ready(sample.t_ns);
  out.fault = static_cast<msg::KickerFault>(sample.fault);
  out.last_kick_id = gate_.last_kick_id();
  out.last_accepted = gate_.last_accepted();
  out.orders_handled = gate_.handled();
  out.orders_refused = gate_.refused();
  status_out_.write(out);
  report_done(sample.t_ns);
}

void KickerDriverNode::on_order(const msg::KickOrder& order) {
  const std::lock_guard lock{mutex_};
  const std::int64_t now = now_t_ns();
  const msg::Refusal refusal = gate_.judge(order, now);
  msg::KickReceipt receipt{};
  receipt.robot_id = context_.robot_id();
  receipt.seq = ++receipts_;
  receipt.t_ns = now;
  receipt.kick_id = order.kick_id;
  receipt.accepted = refusal == msg::REFUSAL_NONE;
  receipt.refusal = refusal;
  receipt.order_t_ns = order.t_ns;
  if (receipt.accepted) {
    receipt.power = order.power;
    receipt.fired_t_ns = std::max(now, order.fire_t_ns);
    receipt.release_t_ns = receipt.fired_t_ns + static_cast<std::int64_t>(context_.robot.model.delay_s * 1e9);
    kicker_->fire(order.kick_id, order.power, receipt.fired_t_ns);
    context_.logger->info("kick {} fired with power {:.2f}", order.kick_id, order.power);
  } else {
    context_.logger->warn("kick {} refused: {}", order.kick_id, bus::label(refusal));
  }
  receipt_out_.write(receipt);
  report_done(sample_t_ns_);
}

void KickerDriverNode::report_done(std::int64_t t_ns) {
  step_done(step_done_, context_.robot_id(), msg::STEP_KICKER_DRIVER, t_ns, gate_.handled(),
            gate_.handled() - gate_.refused());
}

}  // namespace trivela::nodes
