#include "evaluator/report/policy_order.hpp"

#include <algorithm>
#include <vector>

#include "kicking/policy/policy.hpp"

namespace trivela::evaluator {

std::size_t order_of(const std::string& name) {
  static const std::vector<std::string> order = [] {
    auto names = kicking::policies_where([](const auto&) { return true; });
    names.insert(names.end(), {"old", "new"});
    return names;
  }();
  return static_cast<std::size_t>(std::ranges::find(order, name) - order.begin());
}

}  // namespace trivela::evaluator
