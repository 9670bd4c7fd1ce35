#include "kicking/ballistics/kick_speeds.hpp"

#include "kicking/ballistics/moving_kick.hpp"

namespace trivela::kicking {

KickSpeeds kick_speeds(const WantedKick& wanted) {
  const OptionalDouble v0_mps = crossing_speed(wanted.point, wanted.exit_angle, wanted.gravity_mps2);
  if (!v0_mps) return {};
  return {.v0_mps = v0_mps,
          .vk_exact_mps = moving_kick_exact(wanted.point, wanted.exit_angle, wanted.u_mps(), wanted.gravity_mps2),
          .vk_paper_mps = moving_kick_paper(*v0_mps, wanted.u_mps(), wanted.exit_angle),
          .descending = descends_through(wanted.point, wanted.exit_angle)};
}

}  // namespace trivela::kicking
