#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "kicking/policy/policy.hpp"

namespace trivela::evaluator {

/// Place of a name in every list of policies, or of height tables: that of the registry (kicking::kPolicyRows), the old
/// table before the new one; all others share the last place.
inline std::size_t order_of(const std::string& name) {
  static const std::vector<std::string> order = [] {
    auto names = kicking::policies_where([](const auto&) { return true; });
    names.insert(names.end(), {"old", "new"});
    return names;
  }();
  return static_cast<std::size_t>(std::ranges::find(order, name) - order.begin());
}

/// Sorts names by order_of(), others behind by alphabet.
struct PolicyOrder {
  bool operator()(const std::string& a, const std::string& b) const {
    return order_of(a) != order_of(b) ? order_of(a) < order_of(b) : a < b;
  }
};

}  // namespace trivela::evaluator
