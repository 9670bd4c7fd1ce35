#include "pages/monitor/kick_ledger.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "evaluator/stats/confidence_sequence.hpp"

namespace trivela::pages {
namespace {

bool is_waited_for(const KnownKick& kick, const LedgerNow& now) {
  if (now.over || now.received_ns - kick.received_ns > kSilenceTimeout_ns) return false;
  const auto robot = now.robots_t_ns.find(kick.robot_id);
  return !kick.decided || robot == now.robots_t_ns.end() || robot->second - kick.decided->t_ns <= kOutcomeTimeout_ns;
}

// Whether this receipt says more than the last one: an order that came twice is refused as `double` after it was fired.
// A driver that was restarted counts from 1.
bool outweighs(const msg::KickReceipt& receipt, const KnownKick::Answered& last) {
  return std::tuple{receipt.refusal != msg::REFUSAL_DOUBLE, receipt.t_ns, receipt.seq} >
         std::tuple{last.refusal != msg::REFUSAL_DOUBLE, last.t_ns, last.seq};
}

// Whether the robot had the ball and might play it: the policy judged.
bool has_ball(const msg::KickDecision& decision) {
  return decision.reason != msg::REASON_NOT_PLAYING && decision.reason != msg::REASON_NO_BALL &&
         decision.reason != msg::REASON_STALE_STATE;
}

namespace stats = evaluator::stats;

RunningDifference difference_of(const RunningRow& older, const RunningRow& newer) {
  return {older.policy, newer.policy,
          stats::efficiency(newer.counts()).value_or(0.0) - stats::efficiency(older.counts()).value_or(0.0),
          stats::difference_sequence(older.counts(), newer.counts())};
}

}  // namespace

KickFate fate_of(const KnownKick& kick, const LedgerNow& now) {
  if (kick.answered && !kick.answered->accepted) return KickFate::kRefused;
  if (!kick.ended) return is_waited_for(kick, now) ? KickFate::kUnderWay : KickFate::kUnknown;
  switch (kick.ended->outcome) {
    case msg::OUTCOME_UNKNOWN:
      return KickFate::kUnknown;
    case msg::OUTCOME_ON_TARGET:
      return kick.decided && !kick.decided->goal_counts ? KickFate::kOutside : KickFate::kInside;
    default:
      return KickFate::kOutside;
  }
}

KnownKick* KickLedger::kick_of(std::uint8_t robot_id, std::int64_t kick_id, std::int64_t received_ns) {
  if (robot_id == 0 || kick_id <= 0) return nullptr;
  const auto known = places_.find({robot_id, kick_id});
  if (known != places_.end()) return &kicks_[known->second];
  if (kicks_.size() >= kMostKicks) {
    ++not_kept_;
    return nullptr;
  }
  places_[{robot_id, kick_id}] = kicks_.size();
  KnownKick& kick = kicks_.emplace_back();
  kick.kick_id = kick_id;
  kick.robot_id = robot_id;
  kick.received_ns = received_ns;
  return &kick;
}

bool KickLedger::goal_counts(const msg::KickDecision& decision) {
  const Taken ball{.half = decision.half,
                   .possession_id = decision.possession_id,
                   .x_m = decision.x_m - rules_.ball_offset_m * std::sin(decision.heading_rad),
                   .y_m = decision.y_m + rules_.ball_offset_m * std::cos(decision.heading_rad)};
  Taken& taken = taken_.try_emplace(decision.robot_id, ball).first->second;
  const bool same = taken.half == ball.half && taken.possession_id == ball.possession_id;
  if (!same || !taken.held) taken = ball;
  taken.held = taken.held || has_ball(decision);
  if (rules_.opponents_half_only && ball.y_m <= 0.0) return false;
  return !(rules_.carry_limit_m > 0.0 && std::hypot(ball.x_m - taken.x_m, ball.y_m - taken.y_m) > rules_.carry_limit_m);
}

void KickLedger::receive(const msg::KickDecision& decision, std::int64_t received_ns) {
  const bool counts = goal_counts(decision);
  if (!decision.fire) return;
  KnownKick* const kick = kick_of(decision.robot_id, decision.kick_id, received_ns);
  if (kick == nullptr || (kick->decided && kick->decided->seq <= decision.seq)) return;
  kick->decided = KnownKick::Decided{.seq = decision.seq,
                                     .t_ns = decision.t_ns,
                                     .policy = {decision.policy, decision.own_policy},
                                     .distance_m = decision.distance_m,
                                     .power = decision.power,
                                     .p_on_target = decision.p_on_target,
                                     .kick_kind = decision.kick_kind,
                                     .goal_counts = counts};
}

void KickLedger::receive(const msg::KickReceipt& receipt, std::int64_t received_ns) {
  KnownKick* const kick = kick_of(receipt.robot_id, receipt.kick_id, received_ns);
  if (kick == nullptr || (kick->answered && !outweighs(receipt, *kick->answered))) return;
  kick->answered = KnownKick::Answered{receipt.t_ns, receipt.seq, receipt.accepted, receipt.refusal};
}

void KickLedger::receive(const msg::KickOutcome& outcome, std::int64_t received_ns) {
  KnownKick* const kick = kick_of(outcome.robot_id, outcome.kick_id, received_ns);
  if (kick == nullptr || (kick->ended && kick->ended->seq >= outcome.seq)) return;
  std::optional<bool> saved;
  if (outcome.outcome == msg::OUTCOME_ON_TARGET && std::isfinite(outcome.p_saved))
    saved = outcome.p_saved > 0.5 * (std::isfinite(outcome.p_on_target) ? outcome.p_on_target : 1.0);
  kick->ended = KnownKick::Ended{outcome.seq, outcome.outcome, saved, outcome.x_cross_m, outcome.z_cross_m};
}

std::map<std::optional<PolicyLabel>, KickTally> KickLedger::tallies(const LedgerNow& now) const {
  constexpr std::array kCounters{&KickTally::under_way, &KickTally::refused, &KickTally::inside, &KickTally::outside,
                                 &KickTally::unknown};  // in the order of KickFate
  static_assert(kCounters.size() == static_cast<std::size_t>(KickFate::kUnknown) + 1);
  std::map<std::optional<PolicyLabel>, KickTally> tallies;
  for (const KnownKick& kick : kicks_) {
    KickTally& tally = tallies[kick.decided ? std::optional{kick.decided->policy} : std::nullopt];
    const KickFate fate = fate_of(kick, now);
    ++(tally.*kCounters.at(static_cast<std::size_t>(fate)));
    tally.goals += fate == KickFate::kInside && kick.ended->saved == false ? 1 : 0;
  }
  return tallies;
}

std::vector<KnownKick> KickLedger::latest(std::size_t most) const {
  const std::size_t n = std::min(most, kicks_.size());
  return {kicks_.rbegin(), kicks_.rbegin() + static_cast<std::ptrdiff_t>(n)};
}

RunningTable running_table(const std::map<std::optional<PolicyLabel>, KickTally>& tallies) {
  RunningTable table;
  std::optional<RunningRow> nobodys;
  for (const auto& [policy, kicks] : tallies) {
    RunningRow row{policy ? policy->name() : "not received", kicks};
    row.interval = stats::confidence_sequence(row.counts());
    if (policy) {
      table.rows.push_back(row);
    } else {
      nobodys = row;
    }
  }
  std::vector<const RunningRow*> compared;
  for (const RunningRow& row : table.rows) {
    if (row.counts().n > 0) compared.push_back(&row);
  }
  if (compared.size() >= 2) table.difference = difference_of(*compared[0], *compared[1]);
  if (nobodys) table.rows.push_back(*nobodys);
  return table;
}

}  // namespace trivela::pages
