#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "kicking/geometry/goal.hpp"

namespace trivela::evaluator {

/// Numbers of what sessions were played with: the same number, the same text.
struct SessionSetup {
  std::uint32_t world = 0;     ///< the scenario, whatever its file is called
  std::uint32_t settings = 0;  ///< settings and robots, but for who is in charge of the kicks, and how long
};

/// Tells the configurations of a comparison's sessions apart.
class SetupIndex {
 public:
  /// `config` as table `texts` has it: "### settings", "### robot" and, of a simulated session, "### scenario".
  SessionSetup of(const std::string& config);

 private:
  using Numbers = std::map<std::string, std::uint32_t>;
  Numbers worlds_;
  Numbers settings_;
};

/// The field that a session was played on.
struct LoggedPitch {
  kicking::Goal goal{};
  double side_line_x_m = 6.0;
};

/// Out of [goal] and [field] of a session's configuration, as table `texts` has it; what it does not say stays as it is
/// by default.
LoggedPitch pitch_of(std::string_view config);

}  // namespace trivela::evaluator
