#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "evaluator/sessions/same_match.hpp"
#include "evaluator/sessions/session_facts.hpp"
#include "log/read/reader.hpp"

namespace trivela::evaluator {

/// Places of sessions by their id.
using SessionPlaces = std::unordered_map<std::int64_t, std::uint32_t>;

/// The sessions of several logs, each kick of which counts once: the one place that decides it for every verb.
class SessionIndex {
 public:
  /// The sessions of a log that none before had. To be called before settle().
  SessionPlaces add(const log::Reader& reader, const std::string& name);

  /// Finds out what counts and gives each session the number of its match. What follows holds from then on.
  void settle();

  /// Throws std::runtime_error naming a log where there are replays and nothing else.
  void refuse_replays_alone() const;

  const std::vector<ComparedSession>& sessions() const { return sessions_; }
  std::uint32_t matches() const { return matches_; }

  /// Whether this recording of the kick is the one that counts.
  bool counts(std::uint32_t session, int robot_id, std::int64_t kick_id) const;

  /// What does not count, in what the sessions of `places` recorded.
  std::vector<std::int64_t> sessions_left_out(const SessionPlaces& places) const;
  std::vector<log::RecordedKick> kicks_left_out(const SessionPlaces& places) const;

  /// Sentences on sessions that were not closed, and on experiments under way.
  const std::vector<std::string>& remarks() const { return remarks_; }

  /// Sentences on what does not count, or not twice.
  const std::vector<std::string>& not_counted() const { return not_counted_; }

 private:
  void note_log(const log::Reader& reader, const std::string& name, std::int64_t again, std::int64_t open);
  void note_left_out();
  void number_matches();

  using KickKey = std::tuple<std::uint32_t, int, std::int64_t>;  // session, robot, kick

  std::vector<ComparedSession> sessions_;
  std::vector<std::string> logs_;  // their names
  std::vector<KickRecording> kicks_;
  std::map<KickKey, bool> left_out_;  // whether another recording of the match has it
  std::uint32_t matches_ = 0;
  std::vector<std::string> remarks_;
  std::vector<std::string> not_counted_;
  std::unordered_set<std::int64_t> known_;
  SetupIndex setups_;
};

}  // namespace trivela::evaluator
