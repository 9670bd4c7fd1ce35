#pragma once

#include <vector>

#include "tests/faults/campaign.hpp"
#include "tests/faults/testimony.hpp"

namespace trivela::faults {

/// Whether bits are turned over in what the driver hears.
bool garbles_driver(const Fault& fault);

/// The device's witness with the referee's words as the driver may have heard them where its own reader is no measure
/// of that:
///
/// - under garbled words its reader may grow deaf for good like anybody's, while the driver's does not: what the
/// referee
///   really said, as the wire's witness heard it, is added for as long as such a fault on the driver's cable lasted;
/// - on a delayed way each reader has a copy of its own, whose delay is drawn again: instead of the witness's copies
/// stand
///   the driver's, a word to play as early and one to stop as late as the way may bring them, in the order in which
///   they were said.
Testimony with_drivers_words(Testimony device, const Testimony& wire, const std::vector<Trial>& trials);

}  // namespace trivela::faults
