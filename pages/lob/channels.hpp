#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace trivela::pages {

/// What the page of lobs follows. A frame may be skipped; the others are snapshots of a whole, so that the newest says
/// all.
enum Channel : std::size_t { kSetup, kLobs, kStatus, kFrame };

/// Their names as events.
inline std::vector<std::string> lob_channels() { return {"setup", "lobs", "status", "frame"}; }

}  // namespace trivela::pages
