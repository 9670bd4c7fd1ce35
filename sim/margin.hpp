#pragma once

#include "kicking/geometry/goal.hpp"
#include "sim/truth.hpp"

namespace trivela::sim {

/// Distance of a crossing from the nearest edge beyond which kicking::classify() says something else [m]. The edges are
/// those of the bands in which the ball overlaps posts and bar, and the floor has none.
double margin_m(const Crossing& crossing, const kicking::Goal& goal, const kicking::Ball& ball);

}  // namespace trivela::sim
