#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "kicking/ballistics/flight.hpp"

namespace trivela::calibration {

/// Order to release of one kick [s]: the instant at which two straight tracks over the floor meet. The one in the
/// handler is fitted to the 0.2 s before the order; the one in flight to the first eight sightings farther than 0.25 m
/// from where the ball would be in the handler, slowed by the drag of kicking::Ball and kicking::Air: s = v (t - k |v|
/// t^2 / 2). None: fewer than five sightings of either, or no flight within half a second. `sightings` by time; the
/// robot must drive straight and must not turn around the order.
std::optional<double> release_delay_s(std::span<const kicking::Sighting> sightings, std::int64_t order_t_ns);

}  // namespace trivela::calibration
