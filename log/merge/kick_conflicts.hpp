#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "log/merge/merge_source.hpp"

namespace trivela::log {

/// A kick of which two sources say different things. Who knows less says nothing different.
struct KickConflict {
  int robot_id = 0;
  std::int64_t kick_id = 0;
  std::int64_t t_ns = 0;  ///< of the decision
  std::string about;      ///< "policy", "driver", "outcome" or "label"
  struct Said {
    std::string source;  ///< name of the file, without its folder
    std::string what;
  };
  std::vector<Said> said;  ///< of each different thing the first source

  /// "kick 1:4 (outcome): robot1.db says on_target, base.db says over"
  std::string line() const;
};

/// What several files say of the same kicks. A kick is the same by robot, kick_id and instant of the decision, in
/// matches of one seed where they are simulated; in an experiment, whose arms share them, within one session.
class KickConflicts {
 public:
  /// Of a damaged file what can be read.
  void add(const MergeSource& source);

  /// By robot and kick_id.
  std::vector<KickConflict> conflicts() const;

 private:
  using Kick = std::tuple<int, std::int64_t, std::int64_t, std::optional<std::int64_t>, std::int64_t>;
  using Sayings = std::map<std::string, std::vector<KickConflict::Said>>;  // by what they are about

  void say(const Kick& kick, const std::string& about, const std::string& source, const std::string& what);

  std::map<Kick, Sayings> kicks_;
};

}  // namespace trivela::log
