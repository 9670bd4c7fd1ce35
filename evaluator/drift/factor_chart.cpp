#include "evaluator/drift/drift_watch.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trivela::evaluator {
namespace {

constexpr double kFar = -8.0;  // standard deviations, from where on Phi is taken by its tail

double log_below(double c) {
  if (c < kFar) return -0.5 * c * c - std::log(-c * std::sqrt(2.0 * std::numbers::pi));
  return std::log(0.5 * std::erfc(-c / std::numbers::sqrt2));
}

}  // namespace

double mean_below(double c) {
  if (c < kFar) return c;
  return -std::exp(-0.5 * c * c) / std::sqrt(2.0 * std::numbers::pi) / (0.5 * std::erfc(-c / std::numbers::sqrt2));
}

double FactorChart::sd() const {
  return std::sqrt((rule_.expected_weight * rule_.expected_sd * rule_.expected_sd + squares_) /
                   (rule_.expected_weight + static_cast<double>(known_)));
}

void FactorChart::judge(const Group& group, double x, bool at_most) {
  const double sd = this->sd() * std::sqrt(1.0 + 1.0 / static_cast<double>(group.count));  // nor is the mean known
  const double c = (x - group.mean) / sd, d = rule_.shift / sd;
  const double z = std::clamp(c, -rule_.clip, rule_.clip);
  if (at_most) {
    const double as_before = log_below(z);
    up_ = std::max(0.0, up_ + log_below(z - d) - as_before);
    down_ = std::max(0.0, down_ + log_below(z + d) - as_before);
  } else {
    up_ = std::max(0.0, up_ + d * (z - 0.5 * d));
    down_ = std::max(0.0, down_ + d * (-z - 0.5 * d));
  }
}

bool FactorChart::add(double x, bool at_most, int group_id) {
  Group& group = groups_[group_id];
  if (at_most && group.count == 0) return false;  // says nothing of a mean that nobody knows
  if (group.count >= static_cast<std::size_t>(rule_.quiet)) judge(group, x, at_most);
  const double sd = this->sd();
  if (at_most) {
    const double c = (x - group.mean) / sd, m = mean_below(c);
    x = group.mean + sd * m;
    squares_ += std::max(0.0, 1.0 + c * m - m * m) * sd * sd;
  }
  if (group.count++ > 0) ++known_;
  const double off = x - group.mean;
  group.mean += off / static_cast<double>(group.count);
  squares_ += off * (x - group.mean);
  return up_ > rule_.limit || down_ > rule_.limit;
}

}  // namespace trivela::evaluator
