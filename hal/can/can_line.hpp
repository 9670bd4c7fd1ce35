#pragma once

#include <memory>
#include <string>

#include "hal/line/line.hpp"

namespace trivela::hal::can {

/// A CAN bus as a line: a write is one frame, and so is a read (hal/can/frame.hpp). `name` is an interface of the
/// kernel, as "can0", whose bit rate its administrator has set; or, where it has a '/', the path of a SOCK_SEQPACKET
/// socket with an emulator behind it. `host`: what it gives orders to, such as "kicker"; while the line is open no
/// other line opens as the same host of this bus, in any program. Empty: it only listens.
std::unique_ptr<Line> can_line(const std::string& name, const std::string& host = {});

}  // namespace trivela::hal::can
