#include "nodes/kicker_driver/kicker_driver_node.hpp"

#include "nodes/runtime/step_done.hpp"

namespace trivela::nodes {
KickerDriverNode::KickerDriverNode(NodeContext& context, std::unique_ptr<hal::Kicker> kicker)
    : context_(context),
      kicker_(std::move(kicker)),
      desk_(context.settings, context.robot.model, context.robot_id()),
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
      [this](const hal::KickerSample& sample) { on_sample(sample); },
      bus::writes<msg::KickerStatus, msg::KickReceipt, msg::SimFire, msg::StepDone>());
  // In lockstep the word of a cycle comes with its sample, when no order's instant lies ahead.
  if (!context_.settings.run.lockstep)
    node_.on<msg::Referee>([this](const msg::Referee& word) { on_referee(word); },
                           bus::writes<msg::KickReceipt, msg::SimFire>());
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
  status_out_.write(desk_.status(sample, referee && referee->playing));
  withdraw();
  report_done(sample.t_ns);
}

void KickerDriverNode::on_referee(const msg::Referee& word) {
  if (word.playing) return;
  const std::lock_guard lock{mutex_};
  desk_.stop();
  withdraw();
}

/// Calls a kick off that the device has been told of but has not done yet.
void KickerDriverNode::withdraw() {
  const auto receipt = desk_.withdrawal(now_t_ns());
  if (!receipt) return;
  kicker_->withdraw(receipt->kick_id);
  context_.logger->warn("kick {} called off: {}", receipt->kick_id, bus::label(receipt->refusal));
  receipt_out_.write(*receipt);
}

void KickerDriverNode::on_order(const msg::KickOrder& order) {
  const std::lock_guard lock{mutex_};
  const msg::KickReceipt receipt = desk_.answer(order, now_t_ns());
  if (receipt.accepted) {
    kicker_->fire(receipt.kick_id, receipt.power, receipt.fired_t_ns);
    context_.logger->info("kick {} fired with power {:.2f}", order.kick_id, order.power);
  } else {
    context_.logger->warn("kick {} refused: {}", order.kick_id, bus::label(receipt.refusal));
  }
  receipt_out_.write(receipt);
  report_done(sample_t_ns_);
}

void KickerDriverNode::report_done(std::int64_t t_ns) {
  step_done(step_done_, context_.robot_id(), msg::STEP_KICKER_DRIVER, t_ns, desk_.handled(), desk_.fires());
}

}  // namespace trivela::nodes
