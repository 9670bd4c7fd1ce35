#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "kicking/outcome/opponents.hpp"

namespace trivela::robot {

/// Whether the opponents' keeper guesses, learned from its way d after each kick: when one that waits for the ball has
/// hardly begun. With m = a t^2 / 2 the way of one that jumped, b that to where the ball crosses, sd^2 the variance:
///
///     it waits:             N(0, sd^2)
///     it follows the ball:  N(b u, sd^2), u = 1/4, 1/2, 3/4, 1 alike often
///     it guesses:           N(m, sd^2) or N(-m, sd^2) alike often
///
/// by Bayes' rule; between two kicks it may change. A kick tells nothing where the keeper is not in sight.
class KeeperHabit {
 public:
  explicit KeeperHabit(const kicking::KeeperConfig& keeper);

  /// The robot's ball leaves at that instant, and is expected at x_cross_m of the goal line.
  void kicked(std::int64_t release_t_ns, double x_cross_m) { kick_ = Kick{release_t_ns, x_cross_m}; }

  /// What is known of the keeper in a cycle of t_ns.
  void see(std::int64_t t_ns, const std::optional<kicking::KeeperPlace>& keeper);

  /// The last kick tells nothing.
  void forget_kick() { kick_.reset(); }

  double p_guesses() const { return p_[2]; }
  bool guesses() const { return p_guesses() > 0.5; }

 private:
  struct Kick {
    std::int64_t release_t_ns = 0;
    double x_cross_m = 0.0;
    std::optional<kicking::KeeperPlace> stood{};  // at the release
  };
  void learn(double gone_m, double way_m, double var_m2);

  double look_s_;  // after the release
  double jump_m_;  // of one that guesses, as it is seen then
  std::array<double, 3> prior_;
  std::array<double, 3> p_;
  std::optional<Kick> kick_;
};

}  // namespace trivela::robot
