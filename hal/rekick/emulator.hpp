#pragma once

#include "hal/line/emulator.hpp"
#include "hal/rekick/emulated_board.hpp"

namespace trivela::hal::rekick {

/// A ReKick board that is not there, behind a SOCK_SEQPACKET socket in place of a CAN bus.
using Emulator = hal::Emulator<EmulatedBoard>;

}  // namespace trivela::hal::rekick
