#include "cli/hardware/tasks.hpp"

#include <fmt/core.h>
#include <poll.h>

#include <stdexcept>

#include "cli/options/output.hpp"
#include "cli/verbs.hpp"
#include "kicking/geometry/time.hpp"
#include "robot/driver/order_gate.hpp"

namespace trivela::cli {
namespace {

using KickClock = std::chrono::steady_clock;
constexpr std::int64_t kTestKick = 1;
constexpr std::chrono::seconds kKickerTimeout{3};
constexpr std::chrono::milliseconds kSampleWait{50};
constexpr std::chrono::milliseconds kOutcomeTimeout{500};  // until the board has said what became of the shot

/// Takes what the kicker says until `done` or the timeout is over. False: somebody asked to stop.
bool listen(hal::Kicker& kicker, robot::OrderGate& gate, std::optional<hal::KickerSample>& newest,
            KickClock::time_point end, SignalInbox& signals, auto done) {
  while (!done() && KickClock::now() < end) {
    if (const auto sample = kicker.read(kSampleWait)) {
      newest = sample;
      gate.device(*sample);
    }
    if (signals.stop_requested()) return false;
  }
  return true;
}

bool healthy(const hal::KickerSample& sample) { return sample.fault == hal::KickerFault::kNone; }

int not_fired(const std::string& why) {
  warn(why + ": nothing was fired");
  return kFailed;
}

msg::KickOrder order_of(double power, double validity_s, std::uint8_t robot_id) {
  msg::KickOrder order{};
  order.robot_id = robot_id;
  order.seq = 1;
  order.kick_id = kTestKick;
  order.t_ns = order.fire_t_ns = steady_ns();
  order.valid_until_t_ns = order.t_ns + kicking::nanoseconds(validity_s);
  order.power = power;
  order.possession = true;  // the person has said that the ball lies there
  return order;
}

/// Fires what the gate has passed, and says what became of it.
int carry_out(hal::Kicker& kicker, robot::OrderGate& gate, const msg::KickOrder& order, SignalInbox& signals) {
  std::optional<hal::KickerSample> newest;
  const std::string before = kicker.status();
  while (kicker.take_result()) continue;  // of shots before this one
  kicker.fire({.kick_id = order.kick_id,
               .power = order.power,
               .t_ns = order.t_ns,
               .until_ns = order.valid_until_t_ns,
               .judged_ns = order.t_ns});
  listen(kicker, gate, newest, KickClock::now() + kOutcomeTimeout, signals, [] { return false; });
  const std::string status = kicker.status();
  if (status != before && !status.empty()) say(fmt::format("kicker says: {}\n", status));
  if (const auto result = kicker.take_result(); result && result->what != hal::ShotResult::What::kFired) return kFailed;
  say(fmt::format("fired with set-point {:.2f}; {}\n", order.power, newest ? kicker_text(*newest) : "no sample"));
  return kDone;
}

}  // namespace

std::string refused_at_once(const hal::KickerSample& sample, const config::KickerDevice& device,
                            const std::string& status) {
  if (!healthy(sample))
    return fmt::format("refused, fault; {}{}{}", kicker_text(sample), status.empty() ? "" : "; ", status);
  return sample.armed ? "" : fmt::format("refused, unarmed: {}; {}", config::unarmed_by(device), kicker_text(sample));
}

int fire_test_kick(hal::Kicker& kicker, const config::Settings& settings, const config::Robot& robot, Operator& user,
                   SignalInbox& signals) {
  const Afterwards nothing_energised{[&] {
    kicker.charge(hal::ChargeCommand::kDischarge);  // where the device can
    kicker.make_safe();
  }};
  const kicking::Range powers{robot.model.table.front().power, robot.model.table.back().power};
  robot::OrderGate gate{settings.kicker_driver, {powers}, settings.run.cycle_s};
  gate.referee(robot::RefereePermission::kPlay);
  std::optional<hal::KickerSample> newest;
  if (!listen(kicker, gate, newest, KickClock::now() + kKickerTimeout, signals,
              [&] { return newest && healthy(*newest) && newest->armed; }))
    return not_fired("stopped");
  if (!newest) throw std::runtime_error{fmt::format("the kicker does not answer: {}", kicker.status())};
  const std::string refused = refused_at_once(*newest, settings.hal.kicker, kicker.status());
  if (!refused.empty()) return not_fired(refused);
  say(
      fmt::format("kicker: {}\n"
                  "One kick with set-point {:.2f}, the lowest of {}. No referee is asked: you are the referee.\n"
                  "Lay the ball into the handler. Is nobody in front of the robot, and nobody's hand near it?\n",
                  kicker_text(*newest), powers.min, robot.name));
  if (!user.confirms("kick")) return not_fired("not confirmed");
  const std::chrono::duration<double> timeout =
      kKickerTimeout + std::chrono::duration<double>{config::modelled_charge_s(settings.hal.kicker)};
  say(fmt::format("It charges; the shot comes by itself within {:.0f} s. Ctrl-C calls it off.\n", timeout.count()));
  std::fflush(stdout);
  kicker.charge(hal::ChargeCommand::kCharge);
  newest.reset();  // what waited while the person thought is too old
  if (!listen(kicker, gate, newest, KickClock::now() + std::chrono::duration_cast<KickClock::duration>(timeout),
              signals, [&] { return newest && healthy(*newest) && (!newest->armed || gate.ready(steady_ns())); }))
    return not_fired("stopped");
  const msg::KickOrder order =
      order_of(powers.min, settings.kick_decision.order_validity_s, static_cast<std::uint8_t>(settings.run.robot_id));
  const msg::Refusal refusal = gate.judge(order, steady_ns(), robot::OrderBy::kOwnDecision);
  if (refusal != msg::REFUSAL_NONE)
    return not_fired(fmt::format("refused, {}; {}", bus::label(refusal), newest ? kicker_text(*newest) : "no sample"));
  return carry_out(kicker, gate, order, signals);
}

}  // namespace trivela::cli
