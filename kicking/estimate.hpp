#pragma once

namespace trivela::kicking {

/// A number with its standard error.
struct Estimate {
  double value = 0.0;
  double se = 0.0;
};

}  // namespace trivela::kicking
