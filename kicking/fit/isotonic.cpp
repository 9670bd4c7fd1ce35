#include "kicking/fit/table_fit.hpp"

#include <algorithm>
#include <cmath>

namespace trivela::kicking {
namespace {

constexpr double kStepOfPool_mps = 0.002;

struct Pool {
  double speed_mps = 0.0;
  double weight = 0.0;
  std::size_t members = 0;
};

/// Pool adjacent violators: the least-squares fit among those that never fall. Nearer than one step is equal.
std::vector<Pool> pooled(std::span<const WeightedSpeed> speeds) {
  std::vector<Pool> pools;
  for (const WeightedSpeed& speed : speeds) {
    pools.push_back({speed.speed_mps, speed.weight, 1});
    while (pools.size() > 1 && pools[pools.size() - 2].speed_mps + kStepOfPool_mps > pools.back().speed_mps) {
      const Pool last = pools.back();
      pools.pop_back();
      Pool& before = pools.back();
      before.speed_mps =
          (before.weight * before.speed_mps + last.weight * last.speed_mps) / (before.weight + last.weight);
      before.weight += last.weight;
      before.members += last.members;
    }
  }
  return pools;
}

}  // namespace

std::vector<double> rising_speeds(std::span<const WeightedSpeed> speeds) {
  const std::vector<Pool> pools = pooled(speeds);
  std::vector<double> rising;
  for (std::size_t p = 0; p < pools.size(); ++p) {
    const double below = p > 0 ? pools[p].speed_mps - pools[p - 1].speed_mps : HUGE_VAL;
    const double above = p + 1 < pools.size() ? pools[p + 1].speed_mps - pools[p].speed_mps : HUGE_VAL;
    // Half of a gap at most belongs to the pools on its two sides, so that they never meet.
    const double room = 0.5 * std::min(below, above);
    const double step = std::min(kStepOfPool_mps, room / static_cast<double>(pools[p].members));
    for (std::size_t m = 0; m < pools[p].members; ++m) {
      const double place = static_cast<double>(m) - 0.5 * static_cast<double>(pools[p].members - 1);
      rising.push_back(pools[p].speed_mps + place * step);
    }
  }
  return rising;
}

}  // namespace trivela::kicking
