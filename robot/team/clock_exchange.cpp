#include "robot/team/clock_exchange.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace trivela::robot {
namespace {

constexpr std::size_t kMost = 256;  // of a direction: 10 Hz over the window, twice and more
std::int64_t drift_ns(std::int64_t span_ns) {
  return static_cast<std::int64_t>(std::ceil(ClockExchange::kLargestDrift * static_cast<double>(std::abs(span_ns))));
}

}  // namespace

void ClockExchange::add(Ways& ways, const Way& way) {
  const auto known = [&](const Way& w) { return w.passage.sent_t_ns == way.passage.sent_t_ns; };
  if (std::ranges::any_of(ways, known)) return;
  ways.push_back(way);
  if (ways.size() > kMost) ways.pop_front();
}

void ClockExchange::received(const Passage& theirs) {
  if (!is_instant(theirs.sent_t_ns) || !is_instant(theirs.received_t_ns)) return;
  add(theirs_, {theirs.received_t_ns, theirs.received_t_ns - theirs.sent_t_ns, theirs});
}

void ClockExchange::told(const Passage& ours) {
  if (!is_instant(ours.sent_t_ns) || !is_instant(ours.received_t_ns)) return;
  add(ours_, {ours.sent_t_ns, ours.received_t_ns - ours.sent_t_ns, ours});
}

const ClockExchange::Way* ClockExchange::best(const Ways& ways, std::int64_t now_ns) {
  const Way* best = nullptr;
  const auto worth = [now_ns](const Way& way) { return way.took_ns + drift_ns(now_ns - way.here_t_ns); };
  for (const Way& way : ways) {
    if (now_ns - way.here_t_ns > kWindow_ns || way.here_t_ns > now_ns) continue;
    if (best == nullptr || worth(way) < worth(*best)) best = &way;
  }
  return best;
}

std::optional<Passage> ClockExchange::quickest(std::int64_t now_ns) const {
  const Way* const way = best(theirs_, now_ns);
  return way == nullptr ? std::nullopt : std::optional{way->passage};
}

std::optional<OffsetEstimate> ClockExchange::estimate(std::int64_t now_ns) {
  const Way* const there = best(ours_, now_ns);
  const Way* const back = best(theirs_, now_ns);
  if (there == nullptr || back == nullptr) return std::nullopt;
  const std::int64_t oldest_ns = now_ns - std::min(there->here_t_ns, back->here_t_ns);
  const std::int64_t error_ns = (there->took_ns + back->took_ns) / 2 + drift_ns(oldest_ns);
  if (error_ns < 0) {
    theirs_.clear();
    ours_.clear();
    return std::nullopt;
  }
  return OffsetEstimate{(there->took_ns - back->took_ns) / 2, error_ns};
}

}  // namespace trivela::robot
