#pragma once

namespace trivela::evaluator {

/// The first line of everything that was played in the simulation.
inline constexpr const char* kSimulated =
    "SIMULATED: the numbers describe the simulation's assumptions, not robots on a field.\n";

/// The same in a figure.
inline constexpr const char* kSimulatedFigure = "simulated: the simulation's assumptions, not robots on a field";

}  // namespace trivela::evaluator
