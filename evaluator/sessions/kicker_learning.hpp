#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "log/read/reader.hpp"

namespace trivela::evaluator {

/// A number with its standard error, of one part of a kicker.
struct LearnedPart {
  double value = 0.0;
  double se = 0.0;
};

/// What was believed of a kicker after a kick; differences from the robot's file.
struct KickerStep {
  std::int64_t kick_id = 0;  ///< 0: before the first one
  std::int64_t kicks = 0;    ///< learned from
  LearnedPart speed_ln, elevation_rad, direction_rad, delay_s, along, sideways;
  double p_mistaken = 0.0;  ///< probability that the kick's sightings said nothing of the kicker
  double chi_square = 0.0;  ///< of its flight against what was believed before
  /// How much higher the ball crosses than the file says, by what was believed before the kick; none: not known.
  std::optional<double> higher_m;
};

/// What one robot learned of its kicker in one session.
struct LearnedKicker {
  std::int64_t session_id = 0;
  int robot_id = 0;
  bool used = false;  ///< decisions went by it
  std::vector<KickerStep> steps;
  std::string log{};  ///< its name, where there are several

  std::string who() const;  ///< such as "robot 1 (second.db)"
  std::int64_t kicks() const { return steps.back().kicks; }
  std::int64_t mistaken() const;
  double mean_chi_square() const;  ///< of the last 30 flights; 4 where the estimate knows how good it is
  /// Its flights lie about as far from it as it says: it may be believed. False also for fewer than five kicks.
  bool valid() const;
  std::optional<double> higher_m() const;  ///< mean over the kicks
  /// What decisions did or would have done with it, and whether it may be believed.
  std::vector<std::string> sentences() const;
};

/// By session and robot; those without a kick that they learned from are left out.
std::vector<LearnedKicker> learned_kickers_of(const log::Reader& reader);

}  // namespace trivela::evaluator
