#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "robot/watch/sequence_watch.hpp"
#include "robot/watch/silence_watch.hpp"

namespace trivela::pages {

/// Which robots' streams are silent and what was missed of them, by the listener's clock alone, so that it holds in
/// lockstep as well.
class StreamStatus {
 public:
  /// How often look() is meant to be called.
  static constexpr std::int64_t kStep_ns = 100'000'000;

  /// A silence that a person need not know of: a page is for eyes, and a machine may be busy.
  static constexpr double kShortestSilence_s = 0.5;

  /// What was missed is news for so long.
  static constexpr std::int64_t kNews_ns = 10'000'000'000;

  /// One more stream, silent after three periods, but no less than kShortestSilence_s; 0: it has none. Returns its
  /// place.
  std::size_t add(const std::string& topic, double period_s);

  /// `seq`: none where the message has no number.
  void received(std::size_t stream, std::uint8_t robot_id, std::optional<std::uint64_t> seq, std::uint64_t writer,
                std::int64_t now_ns);

  void look(std::int64_t now_ns);

  /// Robots that were ever heard.
  std::set<std::uint8_t> robots() const;
  /// Topics of the robot that are silent, of those that were heard of it.
  std::vector<std::string> silent(std::uint8_t robot_id) const;
  /// It has streams with a period, and all of them are silent.
  bool all_silent(std::uint8_t robot_id) const;
  bool was_received(const std::string& topic) const;

  /// Messages that were missed since kNews_ns, by robot and topic.
  std::map<std::pair<std::uint8_t, std::string>, std::int64_t> missed_lately(std::int64_t now_ns) const;
  /// Ever, and not made good since.
  std::int64_t missed() const { return missed_; }

 private:
  struct Stream {
    std::string topic;
    std::optional<std::size_t> watched;  // where it has a period
    robot::SequenceWatch numbers{};
    std::set<std::uint8_t> robots{};
  };
  struct Missed {
    std::int64_t now_ns;
    std::uint8_t robot_id;
    std::size_t stream;
    std::int64_t messages;
  };

  std::vector<Stream> streams_;
  std::vector<std::size_t> stream_of_edge_;
  robot::SilenceWatch watch_{kStep_ns};
  std::set<std::pair<std::uint8_t, std::size_t>> silent_;  // robot and stream
  std::deque<Missed> lately_;
  std::int64_t missed_ = 0;
};

}  // namespace trivela::pages
