#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "config/settings.hpp"
#include "hal/kicker.hpp"
#include "idl/messages.hpp"
#include "kicking/range.hpp"
#include "robot/driver/kicker_machine.hpp"
#include "robot/watch/referee_watch.hpp"

namespace trivela::robot {

/// Who wrote an order. In one process, without a bus, there is nobody else.
enum class OrderBy { kOwnDecision, kUnauthorised };

/// The last word on every order: the one place that decides whether the coil may be energised.
///
/// An order passes when all of this holds. The first that does not is the refusal:
/// - the robot's own decision node wrote it;
/// - the device is sound: no fault, and samples neither older than link_timeout_s nor from more than
///   future_tolerance_s ahead;
/// - the robot has its kind of kick, its power is finite and inside the set-points, its kick_id is above 0;
/// - the ball lay in the handler where it was judged;
/// - the kicker is armed (switch on, referee heard and playing), and the decision node lives;
/// - it was judged at most max_order_age_s ago, is not past its valid_until_t_ns, and is neither judged nor to be fired
///   more than future_tolerance_s ahead;
/// - it is to be fired from the instant of its judgement on and within a cycle of that;
/// - its kick_id is not among the last kRemembered accepted, the last kick is over and min_interval_s ago;
/// - the capacitor holds min_charge_ratio;
/// - the lever stands for its kind of kick.
///
/// A refused order keeps nobody's kick_id: it is known again only as a whole, and then it is a double. An
/// unauthorised order is counted and leaves nothing else behind.
class OrderGate {
 public:
  /// How many accepted orders, and how many refused ones, are known again.
  static constexpr std::size_t kRemembered = 64;

  /// `powers`: the set-points that the robot's kicker accepts, of each kind of kick.
  OrderGate(const config::KickerDriver& settings, std::vector<kicking::Range> powers, double cycle_s)
      : settings_(settings), powers_(std::move(powers)), cycle_s_(cycle_s) {}

  /// Somebody before it may have fired at `t_ns`: the next kick is min_interval_s after that.
  void rest_from(std::int64_t t_ns) { last_fire_t_ns_ = t_ns; }

  void device(const hal::KickerSample& sample) { device(sample, sample.fault); }
  /// The same of a device that has another fault than it says.
  void device(const hal::KickerSample& sample, hal::KickerFault fault) {
    sample_ = sample;
    sample_->fault = fault;
  }
  void referee(RefereePermission says) { referee_ = says; }
  /// Whether the robot's own decision node is known to live.
  void decision_node(bool there) { decision_there_ = there; }

  /// Judges `order` at `now_t_ns` and remembers it as answered. REFUSAL_NONE: fire.
  msg::Refusal judge(const msg::KickOrder& order, std::int64_t now_t_ns, OrderBy by);

  /// An accepted order that must not be fired after all.
  struct Withdrawal {
    std::int64_t kick_id;
    std::int64_t order_t_ns;
    msg::Refusal reason;
  };

  /// The accepted order whose instant lies ahead of `now_t_ns`, where by now the device is not sound or not armed. It
  /// counts as refused from then on, and the next order as if it had not been.
  std::optional<Withdrawal> withdraw(std::int64_t now_t_ns);

  /// The device was not told of the last accepted order `kick_id` after all. As withdraw(), for `reason`.
  std::optional<Withdrawal> drop(std::int64_t kick_id, msg::Refusal reason);

  /// The device was told of the kick `kick_id` at `t_ns`: the next one is min_interval_s after that.
  void fired(std::int64_t kick_id, std::int64_t t_ns);

  /// Switch on, device heard of, game playing.
  bool armed() const { return sample_ && sample_->armed && referee_ == RefereePermission::kPlay; }

  /// The device has no fault, and its status is fresh.
  bool healthy(std::int64_t now_t_ns) const;
  /// The capacitor holds what a kick needs. A charge above the whole is a device's that cannot be believed.
  bool charged() const {
    return sample_ && sample_->charge >= settings_.min_charge_ratio && sample_->charge <= kMostCharge;
  }
  /// The instant of an accepted order lies ahead, or its pulse runs.
  bool under_way(std::int64_t now_t_ns) const;
  /// The last kick is min_interval_s ago.
  bool rested(std::int64_t now_t_ns) const;

  /// An order within range that came at `now_t_ns` would be accepted.
  bool ready(std::int64_t now_t_ns) const;

  std::int64_t last_kick_id() const { return last_kick_id_; }
  bool last_accepted() const { return last_accepted_; }
  std::uint32_t handled() const { return handled_; }
  std::uint32_t refused() const { return refused_; }

 private:
  bool known(const msg::KickOrder& order) const;
  void remember(const msg::KickOrder& order, bool accepted);
  msg::Refusal disarmed() const;
  msg::Refusal reason(const msg::KickOrder& order, std::int64_t now_t_ns, OrderBy by) const;

  config::KickerDriver settings_;
  std::vector<kicking::Range> powers_;
  double cycle_s_;
  std::optional<hal::KickerSample> sample_;
  RefereePermission referee_ = RefereePermission::kNothing;
  bool decision_there_ = true;
  std::optional<std::int64_t> last_fire_t_ns_;
  struct Accepted {
    std::int64_t kick_id;
    std::int64_t order_t_ns;
    std::int64_t fire_t_ns;
    std::optional<std::int64_t> fire_before_t_ns;  // last_fire_t_ns_ before it
  };
  std::optional<Accepted> accepted_;  // the last one
  // Two rings, so that refused orders push no accepted one out.
  std::array<std::int64_t, kRemembered> accepted_ids_{};  // 0, which is no kick's, where none yet
  std::size_t oldest_accepted_ = 0;
  std::array<msg::KickOrder, kRemembered> refused_orders_{};  // kick_id 0 where none yet
  std::size_t oldest_refused_ = 0;
  std::int64_t last_kick_id_ = 0;
  bool last_accepted_ = false;
  std::uint32_t handled_ = 0;
  std::uint32_t refused_ = 0;
};

}  // namespace trivela::robot
