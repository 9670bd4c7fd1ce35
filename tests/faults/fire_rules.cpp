#include "tests/faults/fire_rules.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <tuple>

namespace trivela::faults {
namespace {

using OrdersById = std::multimap<std::int64_t, OrderSeen>;

double ms(std::int64_t ns) { return static_cast<double>(ns) * 1e-6; }

/// Why a fire is too late for an order; empty: it is not.
std::string lateness(const FireSeen& fire, const OrderSeen& order, const FireRules& rules) {
  const std::int64_t ordered_ns = rules.steady_t_ns ? order.t_ns : order.arrival_ns;
  const std::int64_t age_ns = fire.arrival_ns - ordered_ns;
  if (age_ns > rules.max_age_ns + rules.margin_ns) return fmt::format("{:.1f} ms after its order", ms(age_ns));
  if (fire.t_ns - order.t_ns > rules.max_age_ns)
    return fmt::format("to be carried out {:.1f} ms after its order", ms(fire.t_ns - order.t_ns));
  const std::int64_t allowed_ns = rules.max_age_ns;  // beyond any validity there is the age
  const std::int64_t after_ns = fire.t_ns - order.valid_until_t_ns;
  if (after_ns > 0) return fmt::format("to be carried out {:.1f} ms after its order's validity", ms(after_ns));
  const std::int64_t valid_ns = std::min(order.valid_until_t_ns - order.t_ns, allowed_ns);
  if (age_ns > valid_ns + rules.margin_ns)
    return fmt::format("{:.1f} ms after its order, which was valid for {:.1f} ms", ms(age_ns), ms(valid_ns));
  return {};
}

std::optional<Finding> judge_order(const FireSeen& fire, const OrdersById& orders, const FireRules& rules) {
  constexpr std::int64_t kUnauthorisedSession = 0x7ffe;  // session of fault_client's ids, where it orders unauthorised
  if (fire.kick_id >> 48 == kUnauthorisedSession)
    return Finding{Offence::kUnauthorised, fire, "an unauthorised client ordered it"};
  const auto [begin, end] = orders.equal_range(fire.kick_id);
  if (begin == end) return Finding{Offence::kNoOrder, fire, "no order of this id was seen"};
  std::string why;
  for (auto order = begin; order != end; ++order) {
    why = lateness(fire, order->second, rules);
    if (why.empty()) return std::nullopt;
  }
  return Finding{Offence::kStale, fire, why};
}

std::optional<Finding> judge_referee(const FireSeen& fire, const std::vector<CommandSeen>& words,
                                     const FireRules& rules) {
  const auto after =
      std::upper_bound(words.begin(), words.end(), fire.arrival_ns,
                       [](std::int64_t t_ns, const CommandSeen& word) { return t_ns < word.arrival_ns; });
  if (after == words.begin()) return Finding{Offence::kSilent, fire, "the referee had not said anything"};
  auto last = after - 1;
  const std::int64_t silent_ns = fire.arrival_ns - last->arrival_ns;
  if (silent_ns > rules.max_silence_ns + rules.margin_ns)
    return Finding{Offence::kSilent, fire, fmt::format("the referee had been silent for {:.1f} ms", ms(silent_ns))};
  if (last->playing) return std::nullopt;
  while (last != words.begin() && !(last - 1)->playing) --last;
  const std::int64_t stopped_ns = fire.arrival_ns - last->arrival_ns;
  if (stopped_ns <= rules.margin_ns) return std::nullopt;
  return Finding{Offence::kStopped, fire, fmt::format("the game had been stopped for {:.1f} ms", ms(stopped_ns))};
}

std::optional<Finding> judge_interval(const FireSeen& fire, const FireSeen& before, const FireRules& rules) {
  const std::int64_t arrivals_ns = fire.arrival_ns - before.arrival_ns;
  if (arrivals_ns < rules.min_interval_ns - rules.margin_ns)
    return Finding{Offence::kTooSoon, fire, fmt::format("{:.1f} ms after the fire before it", ms(arrivals_ns))};
  const std::int64_t instants_ns = fire.t_ns - before.t_ns;
  if (!rules.steady_t_ns || instants_ns >= rules.min_interval_ns) return std::nullopt;
  return Finding{Offence::kTooSoon, fire,
                 fmt::format("its instant is {:.1f} ms after the one before", ms(instants_ns))};
}

void judge_truths(const Testimony& wire, const OrdersById& orders, const FireRules& rules,
                  std::vector<Finding>& found) {
  if (!rules.steady_t_ns) return;
  for (const TruthSeen& truth : wire.truths) {
    const auto order = orders.find(truth.kick_id);
    if (order == orders.end()) continue;  // said of its fire
    const std::int64_t after_ns = truth.release_t_ns - order->second.t_ns;
    if (after_ns <= rules.max_age_ns + rules.release_delay_ns) continue;
    found.push_back({Offence::kCarriedLate,
                     {truth.arrival_ns, truth.release_t_ns, truth.kick_id},
                     fmt::format("the ball left {:.1f} ms after the order", ms(after_ns))});
  }
}

}  // namespace

const char* name(Offence offence) {
  switch (offence) {
    case Offence::kNoOrder:
      return "without an order";
    case Offence::kUnauthorised:
      return "for an unauthorised client";
    case Offence::kStale:
      return "after its order's time";
    case Offence::kTwice:
      return "a second time";
    case Offence::kStopped:
      return "while stopped";
    case Offence::kSilent:
      return "while the referee was silent";
    case Offence::kTooSoon:
      return "too soon";
    case Offence::kCarriedLate:
      return "carried out late";
  }
  return "";
}

std::vector<FireSeen> fires_carried_out(const Testimony& device, const Testimony& wire, const FireRules& rules) {
  std::vector<FireSeen> all = device.fires;
  std::set<std::tuple<std::int64_t, std::int64_t, bool>> known;
  for (const FireSeen& fire : all) known.insert({fire.kick_id, fire.t_ns, fire.withdrawn});
  for (const FireSeen& fire : wire.fires) {
    if (known.insert({fire.kick_id, fire.t_ns, fire.withdrawn}).second) all.push_back(fire);
  }
  std::map<std::int64_t, std::int64_t> withdrawn_ns;
  for (const FireSeen& fire : all) {
    if (fire.withdrawn) withdrawn_ns.try_emplace(fire.kick_id, fire.arrival_ns);
  }
  std::erase_if(all, [&](const FireSeen& fire) {
    if (fire.withdrawn) return true;
    const auto word = withdrawn_ns.find(fire.kick_id);
    if (word == withdrawn_ns.end() || word->second < fire.arrival_ns) return false;
    return !rules.steady_t_ns || word->second <= std::max(fire.t_ns, fire.arrival_ns) + rules.margin_ns;
  });
  std::stable_sort(all.begin(), all.end(),
                   [](const FireSeen& a, const FireSeen& b) { return a.arrival_ns < b.arrival_ns; });
  return all;
}

std::vector<Finding> judge(const Testimony& device, const Testimony& wire, const FireRules& rules) {
  OrdersById orders;
  for (const Testimony* witness : {&device, &wire}) {
    for (const OrderSeen& order : witness->orders) orders.emplace(order.kick_id, order);
    // Of two who order, a witness's reader may hear another one than the driver's for the moment of the change.
    for (const OrderSeen& order : witness->decided) orders.emplace(order.kick_id, order);
  }
  std::vector<Finding> found;
  const auto add = [&](const std::optional<Finding>& finding) {
    if (finding) found.push_back(*finding);
  };
  std::set<std::int64_t> fired;
  const std::vector<FireSeen> fires = fires_carried_out(device, wire, rules);
  for (std::size_t i = 0; i < fires.size(); ++i) {
    const FireSeen& fire = fires[i];
    add(judge_order(fire, orders, rules));
    if (!fired.insert(fire.kick_id).second) add(Finding{Offence::kTwice, fire, "this id was fired before"});
    add(judge_referee(fire, device.words, rules));
    if (i > 0) add(judge_interval(fire, fires[i - 1], rules));
  }
  judge_truths(wire, orders, rules, found);
  return found;
}

}  // namespace trivela::faults
