#pragma once

#include <span>

#include "evaluator/table2/table2.hpp"

namespace trivela::evaluator {

/// The report of one log.
inline Report make_report(log::Reader&& reader, bool blocked_apart = false) {
  const OpenLog log{&reader, "this log"};
  return make_report(std::span(&log, 1), blocked_apart);
}

}  // namespace trivela::evaluator
