#pragma once

#include "hal/ioboard/emulated_board.hpp"
#include "hal/line/emulator.hpp"

namespace trivela::hal::ioboard {

/// An ioBoard that is not there, on a pseudo-terminal.
using Emulator = hal::Emulator<EmulatedBoard>;

}  // namespace trivela::hal::ioboard
