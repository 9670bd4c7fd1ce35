#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "log/read/reader.hpp"

namespace trivela::evaluator {

/// A kick that counts, with what people and programs call it.
struct NamedKick {
  std::int64_t session_id = 0;
  std::string uuid;  ///< of its session
  int robot_id = 0;
  std::int64_t kick_id = 0;
  std::int64_t number = 0;  ///< of the robot's orders in its own session, from 1
  std::int64_t t_ns = 0;    ///< of the decision, by the session's clock
  double at_s = 0.0;        ///< of the decision, since the session began
  std::string policy;
  std::string observed;                    ///< by the robot's observer; empty: no outcome came
  std::optional<std::string> by_hand;      ///< the label that holds
  std::optional<std::string> labelled_by;  ///< who gave it

  /// "1:4", robot and number.
  std::string name() const;

  /// By the label that holds, as reports count it: the one by hand, else the observer's.
  bool unknown() const {
    const std::string& holds = by_hand ? *by_hand : observed;
    return holds.empty() || holds == "unknown";
  }
};

/// By session and time; refused orders are no kicks. Of several recordings of one kick, that which counts, where
/// read_opportunities() has told the reader; else each. Throws std::runtime_error where the log cannot be read.
std::vector<NamedKick> named_kicks(const log::Reader& reader);

/// The kick that is called "ROBOT:NUMBER", "NUMBER" where one robot alone has it, or by its kick_id; `session`: how the
/// uuid of its session begins, empty: any. Throws std::runtime_error saying which there are where it is none or could
/// be several; the same kick in several recordings is one.
const NamedKick& kick_called(const std::vector<NamedKick>& kicks, const std::string& name, const std::string& session);

}  // namespace trivela::evaluator
