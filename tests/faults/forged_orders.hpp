#pragma once

#include <vector>

#include "tests/faults/fire_rules.hpp"
#include "tests/faults/hub.hpp"

namespace trivela::faults {

/// Whether the fire answers an order whose id the wire had turned into another one: a frame that came to the driver
/// garbled up to a second before holds its kick_id. A message of DDS has no checksum beyond UDP's, which the hub makes
/// agree, so that no receiver could tell.
bool forged_by_the_wire(const Finding& finding, const std::vector<GarbledFrame>& garbled);

/// Takes the findings out that are forged_by_the_wire(), and returns them.
std::vector<Finding> take_forged(std::vector<Finding>& findings, const std::vector<GarbledFrame>& garbled);

}  // namespace trivela::faults
