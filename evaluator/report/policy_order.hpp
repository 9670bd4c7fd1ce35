#pragma once

#include <cstddef>
#include <string>

namespace trivela::evaluator {

/// Place of a name in every list of policies, or of height tables: that of the registry (kicking::kPolicyRows), the old
/// table before the new one; all others share the last place.
std::size_t order_of(const std::string& name);

/// Sorts names by order_of(), others behind by alphabet.
struct PolicyOrder {
  bool operator()(const std::string& a, const std::string& b) const {
    return order_of(a) != order_of(b) ? order_of(a) < order_of(b) : a < b;
  }
};

}  // namespace trivela::evaluator
