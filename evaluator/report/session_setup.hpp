#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace trivela::evaluator {

/// Numbers of what sessions were played with: the same number, the same text.
struct SessionSetup {
  std::uint32_t world = 0;     ///< the scenario, whatever its file is called
  std::uint32_t settings = 0;  ///< settings and robots, but for who is in charge of the kicks, and how long
};

/// Tells the configurations of a comparison's sessions apart.
class SetupBook {
 public:
  /// `config` as table `texts` has it: "### settings", "### robot" and, of a simulated session, "### scenario".
  SessionSetup of(const std::string& config);

 private:
  using Numbers = std::map<std::string, std::uint32_t>;
  Numbers worlds_;
  Numbers settings_;
};

}  // namespace trivela::evaluator
