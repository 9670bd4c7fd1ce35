#pragma once

#include <vector>

#include "evaluator/table2/table2.hpp"

namespace trivela::evaluator {

/// What the rows of a report are counted from.
struct CountedLogs {
  const LoggedOpportunities& logged;
  const std::vector<log::RecordedSession>& sessions;
  const Arms& arms;
  const std::vector<KickerDoubt>& doubts;
};

/// The tables by policy and by robot.
struct ReportRows {
  std::vector<PolicyRow> policies;
  std::vector<RobotRow> robots;  ///< empty: there is one robot
  std::vector<int> robot_ids;    ///< of all that kicked or had the ball
};

ReportRows report_rows(const CountedLogs& logs, bool blocked_apart);

}  // namespace trivela::evaluator
