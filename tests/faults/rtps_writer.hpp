#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "tests/faults/frame.hpp"

namespace trivela::faults {

/// Who writes, on the wire: 12 bytes of the participant, 4 of the writer.
using Guid = std::array<std::uint8_t, 16>;

/// From 32 hexadecimal digits; none: it is something else.
std::optional<Guid> guid_of(std::string_view digits);

/// Makes what `writer` says in an RTPS datagram the word of a writer that nobody knows, so that nobody hears it; all
/// else in the frame stays. Whether there was something.
bool mute(Frame frame, const Guid& writer);

}  // namespace trivela::faults
