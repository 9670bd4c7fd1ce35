#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/faults/testimony.hpp"

namespace trivela::faults {

/// Where the kicks that were fired stand in the recorder's logs.
struct LoggedKicks {
  std::size_t in_a_log = 0;             ///< a receipt of this id says that it was accepted
  std::size_t counted = 0;              ///< no receipt, but the driver's counters in the logs rise by it
  std::vector<FireSeen> lost;           ///< neither
  std::vector<std::string> unreadable;  ///< logs that cannot be read, with the reason
};

/// Looks every fire up. A kick without a receipt is counted where the driver's counters of the last row of
/// kicker_status before it and the first one after it, whichever logs they stand in, differ by at least as many kicks
/// as were fired between the two; `steady_t_ns`: rows and arrivals have the same clock, without which nothing can be
/// counted.
LoggedKicks look_up(const std::vector<FireSeen>& fires, const std::vector<std::filesystem::path>& logs,
                    bool steady_t_ns);

}  // namespace trivela::faults
