#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "evaluator/stats/counts/interval.hpp"
#include "idl/messages.hpp"
#include "kicking/optional_double.hpp"

namespace trivela::pages {

/// What has become of a kick, as Table 2 counts it.
enum class KickFate { kUnderWay, kRefused, kInside, kOutside, kUnknown };

/// A policy as the bus names it.
struct PolicyLabel {
  PolicyLabel(msg::Policy known = msg::POLICY_STOPPED, std::string name = {}) : policy(known), own(std::move(name)) {}
  friend bool operator<(const PolicyLabel& a, const PolicyLabel& b) {
    return std::tie(a.policy, a.own) < std::tie(b.policy, b.own);
  }
  std::string name() const { return policy == msg::POLICY_OWN ? own : msg::label(policy); }

  msg::Policy policy;
  std::string own;  ///< of another program
};

/// What was heard of a kick. Each word may be missing: it got lost, is not there yet, or the page was opened later.
struct KnownKick {
  struct Decided {
    std::uint64_t seq = 0;
    std::int64_t t_ns = 0;
    PolicyLabel policy{};
    double distance_m = 0.0;
    kicking::OptionalDouble power;
    kicking::OptionalDouble p_on_target;
    std::uint8_t kick_kind = 0;  ///< of the robot's kinds of kick, in the order of its file
    bool goal_counts = true;     ///< by the rules, if the ball goes in
  };
  struct Answered {
    std::int64_t t_ns = 0;
    std::uint64_t seq = 0;
    bool accepted = false;
    msg::Refusal refusal{};
  };
  struct Ended {
    std::uint64_t seq = 0;
    msg::Outcome outcome{};
    std::optional<bool> saved;    ///< of one on target: a keeper stopped it; none: not known
    kicking::OptionalDouble x_m;  ///< ball centre at the goal line, in F
    kicking::OptionalDouble z_m;
  };

  std::int64_t kick_id = 0;
  std::uint8_t robot_id = 0;
  std::int64_t received_ns = 0;  ///< the first word of it, by the listener's clock
  std::optional<Decided> decided;
  std::optional<Answered> answered;
  std::optional<Ended> ended;
};

/// Now: by the listener's clock, and as far as each robot's own messages have come.
struct LedgerNow {
  std::int64_t received_ns = 0;
  std::map<std::uint8_t, std::int64_t> robots_t_ns{};
  bool over = false;  ///< nothing more comes
};

/// How long an outcome is waited for: of the robot's own time, and of the listener's where the robot says no more.
inline constexpr std::int64_t kOutcomeTimeout_ns = 10'000'000'000;
inline constexpr std::int64_t kSilenceTimeout_ns = 60'000'000'000;

/// A refused order is no kick; an outcome that never came is unknown; one on target that the rules count as no goal is
/// outside.
KickFate fate_of(const KnownKick& kick, const LedgerNow& now);

/// Kicks by fate; `refused` are none.
struct KickTally {
  std::int64_t inside = 0;
  std::int64_t goals = 0;  ///< of those inside, known that no keeper stopped them
  std::int64_t outside = 0;
  std::int64_t unknown = 0;
  std::int64_t under_way = 0;
  std::int64_t refused = 0;
};

/// From which kicks no goal counts, as the log's view `labelled_kicks` has it.
struct GoalRules {
  bool opponents_half_only = false;  ///< the ball lies in the own half
  double carry_limit_m =
      0.0;  ///< it was carried farther from where the possession's first decision saw it; 0: no limit
  double ball_offset_m = 0.0;  ///< how far before a robot's centre the ball lies
};

/// Joins decisions, receipts and outcomes by kick_id, each kick once however often and in whatever order its words
/// come. As the log's view `kicks` has it: the first decision that fired, the last receipt (one that says `double` last
/// of all), the last outcome.
class KickLedger {
 public:
  static constexpr std::size_t kMostKicks = 10'000;  ///< any participant may say any number of them

  explicit KickLedger(const GoalRules& rules = {}) : rules_(rules) {}

  void receive(const msg::KickDecision& decision, std::int64_t received_ns);
  void receive(const msg::KickReceipt& receipt, std::int64_t received_ns);
  void receive(const msg::KickOutcome& outcome, std::int64_t received_ns);

  /// By policy; under none those whose decision was not heard.
  std::map<std::optional<PolicyLabel>, KickTally> tallies(const LedgerNow& now) const;

  /// The latest ones that were heard of, the newest first.
  std::vector<KnownKick> latest(std::size_t most) const;

  /// Kicks that found no place.
  std::int64_t not_kept() const { return not_kept_; }

 private:
  struct Taken {
    std::uint8_t half = 0;
    std::uint32_t possession_id = 0;
    double x_m = 0.0, y_m = 0.0;  // of the ball
    bool held = false;            // in play; until then it may be laid anywhere
  };
  bool goal_counts(const msg::KickDecision& decision);
  KnownKick* kick_of(std::uint8_t robot_id, std::int64_t kick_id, std::int64_t received_ns);

  GoalRules rules_;
  std::map<std::uint8_t, Taken> taken_;  // by robot: where its possession began
  std::map<std::pair<std::uint8_t, std::int64_t>, std::size_t> places_;
  std::vector<KnownKick> kicks_;  // in the order of their first words
  std::int64_t not_kept_ = 0;
};

/// A row of Table 2 while the match goes on.
struct RunningRow {
  std::string policy;  ///< "not received": of kicks whose decision was not
  KickTally kicks;
  evaluator::stats::Interval interval{0.0, 1.0};  ///< 95 %, of the part inside; holds at every look at once

  /// Inside, of the kicks whose outcome is known.
  evaluator::stats::Counts counts() const { return {kicks.inside, kicks.inside + kicks.outside}; }
};

/// The first two policies that have a kick with a known outcome: newer less older.
struct RunningDifference {
  std::string older;
  std::string newer;
  double value = 0.0;
  evaluator::stats::Interval interval{-1.0, 1.0};  ///< 95 %, holds at every look at once
};

struct RunningTable {
  std::vector<RunningRow> rows;  ///< in the order of the policies
  std::optional<RunningDifference> difference;
};

/// With the intervals of evaluator/stats/confidence_sequence.hpp: whoever looks after each kick, and stops when they
/// like, errs in no more than 5 % of matches. Of the difference that holds however the policy of the next kick
/// is chosen, as long as nobody chooses it by the situation.
RunningTable running_table(const std::map<std::optional<PolicyLabel>, KickTally>& tallies);

}  // namespace trivela::pages
