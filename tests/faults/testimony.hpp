#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace trivela::faults {

// What a witness saw. arrival_ns: CLOCK_MONOTONIC of this machine when it came; the other times are the message's own.

struct OrderSeen {
  std::int64_t arrival_ns = 0;
  std::int64_t t_ns = 0;
  std::int64_t kick_id = 0;
  std::int64_t fire_t_ns = 0;
  std::int64_t valid_until_t_ns = 0;
};

/// What the driver gave to the device.
struct FireSeen {
  std::int64_t arrival_ns = 0;
  std::int64_t t_ns = 0;
  std::int64_t kick_id = 0;
  bool withdrawn = false;  ///< the kick of this id is called off; t_ns means nothing
};

/// A word of the referee.
struct CommandSeen {
  std::int64_t arrival_ns = 0;
  bool playing = false;
};

/// The world's own note of a kick.
struct TruthSeen {
  std::int64_t arrival_ns = 0;
  std::int64_t release_t_ns = 0;
  std::int64_t kick_id = 0;
};

/// All that one witness saw, each in the order of arrival.
struct Testimony {
  std::vector<OrderSeen> orders;
  std::vector<OrderSeen> decided;  ///< the orders that kick_decision says it has given
  std::vector<FireSeen> fires;
  std::vector<CommandSeen> words;
  std::vector<TruthSeen> truths;
  std::map<std::int64_t, std::int64_t> outcome_arrival_ns;          ///< by kick_id, the first one
  std::map<std::string, std::int64_t, std::less<>> last_sample_ns;  ///< by topic, of those heard for their rhythm

  /// Takes a line of fault_witness in (see witness.c). Throws std::runtime_error with a line that is none.
  void note(const std::string& line);
};

}  // namespace trivela::faults
