#pragma once

#include <cstdint>

#include "experiment/play/match_record.hpp"
#include "log/write/experiment_log.hpp"

namespace trivela::experiment {

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
