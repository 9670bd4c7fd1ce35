#include "kicking/fit/least_squares.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace trivela::kicking {
namespace {

void require_finite(std::span<const double> values, const std::string& what) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) {
      throw std::invalid_argument(what + ": row " + std::to_string(i + 1) + " has a value that is not finite");
    }
  }
}

}  // namespace

Spread spread_of(std::span<const double> values) {
  if (values.empty()) throw std::invalid_argument("spread: no values");
  require_finite(values, "spread");
  const auto n = static_cast<double>(values.size());
  Spread spread;
  for (const double value : values) spread.mean += value / n;
  double squares = 0.0;
  for (const double value : values) squares += (value - spread.mean) * (value - spread.mean);
  if (values.size() > 1) spread.sd = std::sqrt(squares / (n - 1.0));
  return spread;
}

OriginLine line_through_origin(std::span<const double> x, std::span<const double> y, const char* what) {
  if (x.size() != y.size()) throw std::invalid_argument(std::string(what) + ": columns of different length");
  if (x.size() < 2) {
    throw std::invalid_argument(std::string(what) + ": " + std::to_string(x.size()) +
                                (x.size() == 1 ? " row, need at least 2" : " rows, need at least 2"));
  }
  require_finite(x, what);
  require_finite(y, what);
  double xx = 0.0;
  double xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += x[i] * x[i];
    xy += x[i] * y[i];
  }
  if (!(xx > 0.0)) throw std::invalid_argument(std::string(what) + ": all speeds are 0, which says nothing of a slope");
  OriginLine line;
  line.slope.value = xy / xx;
  double squares = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    line.residuals.push_back(y[i] - line.slope.value * x[i]);
    squares += line.residuals.back() * line.residuals.back();
  }
  const auto n = static_cast<double>(x.size());
  line.rms = std::sqrt(squares / n);
  line.slope.se = std::sqrt(squares / (n - 1.0) / xx);
  return line;
}

}  // namespace trivela::kicking
