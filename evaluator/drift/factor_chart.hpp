#pragma once

#include <cstddef>
#include <map>

namespace trivela::evaluator {

/// How a chart judges.
struct ChartRule {
  double shift = 0.03;         ///< change of the mean that it is made for, either way
  double limit = 7.2;          ///< nats: it alarms above
  double expected_sd = 0.025;  ///< of one residual, before there are any; counts as so many residuals:
  double expected_weight = 10.0;
  int quiet = 20;     ///< first residuals of a group, which make its mean and are not judged
  double clip = 2.0;  ///< standard deviations: one residual counts as no farther off
};

/// A two-sided CUSUM (Page 1954) of residuals whose mean and spread are not known beforehand: each is judged by those
/// of its group before it, then joins them; the spread is that of all. An increment is the logarithm of the likelihood
/// ratio of a mean that has moved by `shift` to one that has not; with known parameters the mean run length without a
/// change is at least e^limit a side (Lorden 1971). Of a residual that is only known to be at most x the likelihood is
/// that of all below.
class FactorChart {
 public:
  explicit FactorChart(const ChartRule& rule) : rule_(rule) {}

  /// True: it has left its limit.
  bool add(double x, bool at_most, int group = 0);

  double up() const { return up_; }
  double down() const { return down_; }
  double sd() const;

 private:
  struct Group {
    std::size_t count = 0;
    double mean = 0.0;
  };
  void judge(const Group& group, double x, bool at_most);

  ChartRule rule_;
  std::map<int, Group> groups_;
  std::size_t known_ = 0;  // residuals beyond the first of each group
  double squares_ = 0.0;   // sum of squares about the groups' means
  double up_ = 0.0, down_ = 0.0;
};

/// Mean of a normal variable given that it is at most `c` [standard deviations about its mean], in those: -phi / Phi.
double mean_below(double c);

}  // namespace trivela::evaluator
