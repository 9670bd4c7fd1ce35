#pragma once

#include <memory>
#include <string>

#include "hal/range_finder.hpp"

namespace trivela::hal {

/// The SCIP scanner at `address`: "tcp://HOST:PORT" or the path of a serial device, as "/dev/ttyACM0". Nothing is
/// opened yet: connected() and read() do, and a scanner that is not there shows in status(). Throws std::runtime_error
/// naming an address of another form.
std::unique_ptr<RangeFinder> open_range_finder(const std::string& address);

}  // namespace trivela::hal
