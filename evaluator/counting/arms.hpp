#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "evaluator/counting/log_opportunities.hpp"

namespace trivela::evaluator {

/// An arm of an experiment: all its sessions together.
struct Arm {
  std::string name;        ///< "moving"; "moving (2)" where another arm of that name was played otherwise
  std::string log{};       ///< that its first session stands in
  std::string scenario{};  ///< of the first session, and so are those below
  std::string table{};     ///< empty: not known
  std::vector<log::HalfPolicy> policies{};  ///< none: drawn at random
  std::string software_version{};
  std::string config_sha256{};
  std::int64_t configurations = 0;  ///< how many different ones
  std::int64_t sessions = 0;        ///< that count
  std::int64_t matches = 0;         ///< among them
};

/// The arms of some logs, in the order in which they were first played.
struct Arms {
  std::vector<Arm> all;
  std::map<std::int64_t, std::size_t> of_session;  ///< place in `all`, by session_id; none: it is of no arm
  std::vector<std::string> apart;                  ///< sentences on arms of one name that are not added up
};

/// Sessions with the same name of their arm are one arm where they had the same world, table and settings; of
/// calibrations, whose robots differ, where they had the same world and table. Those that count are named first.
Arms arms_of(const LoggedOpportunities& logged, const std::vector<log::RecordedSession>& recorded);

}  // namespace trivela::evaluator
