#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/faults/testimony.hpp"

namespace trivela::faults {

/// Kicks that the driver had accepted in its life so far, at an instant.
struct AcceptedSoFar {
  std::int64_t t_ns = 0;
  std::int64_t accepted = 0;
};

/// What the logs of a campaign say of kicks.
struct KickRows {
  std::map<std::int64_t, bool> accepted;  ///< by kick_id, of the last receipt
  std::vector<AcceptedSoFar> counters;    ///< of kicker_status, by t_ns
  std::vector<std::string> unreadable;    ///< logs that cannot be read, with the reason
};

KickRows read_kick_rows(const std::vector<std::filesystem::path>& logs);

/// Where the kicks that were fired stand.
struct LoggedKicks {
  std::size_t in_a_log = 0;    ///< a receipt of this id says that it was accepted
  std::size_t counted = 0;     ///< no receipt, but the driver's counters in the logs rise by it
  std::vector<FireSeen> lost;  ///< neither
};

/// Looks every fire up. A kick without a receipt is counted where the driver's counters of the last row of
/// kicker_status before it and of the first one after it, whichever logs they stand in, differ by at least as many
/// kicks as were fired between the two; a driver that was started in between counts from 0. `steady_t_ns`: rows and
/// arrivals have the same clock, without which nothing can be counted.
LoggedKicks look_up(const std::vector<FireSeen>& fires, const KickRows& rows, bool steady_t_ns);

}  // namespace trivela::faults
