#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "evaluator/drift/kick_residual.hpp"
#include "idl/messages.hpp"

namespace trivela::nodes {

/// The kicks of one robot out of its messages, joined by kick_id in whatever order they come, as the log's view `kicks`
/// has them: the first decision that fired, the last receipt (one that says `double` last of all), the last outcome.
class KickSeries {
 public:
  static constexpr std::size_t kMostKicks = 10'000;  ///< later ones are passed over

  /// Each is true where a kick has become another one by it; what has an instant below 0 is passed over.
  bool hear(const msg::KickDecision& decision);
  bool hear(const msg::KickReceipt& receipt);
  bool hear(const msg::KickOutcome& outcome);

  /// Those that the driver accepted, by the instants of their decisions.
  std::vector<evaluator::WatchedKick> kicks() const;

 private:
  struct Words {
    std::optional<msg::KickDecision> decision;
    std::optional<msg::KickReceipt> receipt;
    std::optional<msg::KickOutcome> outcome;
  };
  Words* words_of(std::int64_t kick_id);
  static evaluator::WatchedKick watched(const Words& words);

  std::map<std::int64_t, Words> words_;
};

}  // namespace trivela::nodes
