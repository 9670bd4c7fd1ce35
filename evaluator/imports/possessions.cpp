#include "evaluator/imports/possessions.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace trivela::evaluator::imports {

std::vector<Possession> possessions(const TeamLog& log, const std::vector<std::int64_t>& times_ms) {
  std::vector<Possession> found;
  std::map<int, Possession> open;  // by robot
  const auto close = [&](Possession&& possession) {
    if (possession.to_ms - possession.from_ms >= kShortestPossession_ms) found.push_back(std::move(possession));
  };
  for (std::size_t i = 0; i < log.usable.size(); ++i) {
    for (const ToldRobot& robot : log.usable[i].robots) {
      if (!robot.ball_engaged) continue;
      const auto place = open.try_emplace(robot.id, Possession{robot.id, times_ms[i], times_ms[i]}).first;
      if (times_ms[i] - place->second.to_ms >= kSamePossession_ms)
        close(std::exchange(place->second, Possession{robot.id, times_ms[i], times_ms[i]}));
      place->second.to_ms = times_ms[i];
      if (robot.velocity) place->second.speeds_mps.push_back(std::hypot((*robot.velocity)[0], (*robot.velocity)[1]));
    }
  }
  for (auto& [robot_id, possession] : open) close(std::move(possession));
  std::ranges::stable_sort(found, {}, &Possession::to_ms);
  return found;
}

}  // namespace trivela::evaluator::imports
