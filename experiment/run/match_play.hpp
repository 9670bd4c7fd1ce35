#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "experiment/play/play_match.hpp"
#include "experiment/run/experiment.hpp"
#include "log/write/experiment_log.hpp"

namespace trivela::experiment {

/// One arm's match as it was played.
struct ArmMatch {
  PlayedMatch played;
  MatchRecord record;        ///< empty where nothing is recorded
  double processor_s = 0.0;  ///< of the thread that played it
};

/// Gets the match of every arm.
using TakeMatch = std::function<void(std::uint32_t match_id, const std::vector<ArmMatch>& arms)>;

/// Plays the matches of the plan's range from `first` on. `take` gets them in the order of their numbers, whatever
/// order they are played in: one call at a time, by any of the threads, while the others play on. False: watch.stop
/// asked to stop. Rethrows what `take` and the watch throw.
bool play_matches(const ExperimentPlan& plan, std::uint32_t first, bool recorded, const ExperimentWatch& watch,
                  const TakeMatch& take);

/// Writes the messages of matches played in process to the tables that a recorder would write them to.
class MatchTables {
 public:
  explicit MatchTables(log::ExperimentLog& log);

  /// The rows of one session, between begin() and commit() of the log.
  void write(const MatchRecord& record, std::int64_t session_id);

 private:
  template <class T>
  void write(std::size_t table, const std::vector<T>& messages, std::int64_t session_id);
  void write_shadows(const msg::KickDecision& decision, std::int64_t session_id);

  log::ExperimentLog& log_;
  std::size_t referee_, decisions_, shadows_, orders_, receipts_, outcomes_, estimates_, kick_truths_,
      possession_truths_, assignments_;
};

}  // namespace trivela::experiment
