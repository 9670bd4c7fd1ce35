#include "evaluator/imports/fault_counter.hpp"

#include <algorithm>

namespace trivela::evaluator::imports {

Fault* FaultCounter::count(std::string_view name) {
  const auto known = std::ranges::find(faults_, name, &Fault::name);
  if (known == faults_.end()) return &faults_.emplace_back(Fault{.name = std::string(name)});
  ++known->count;
  return nullptr;
}

std::int64_t FaultCounter::of(std::string_view name) const {
  const auto known = std::ranges::find(faults_, name, &Fault::name);
  return known == faults_.end() ? 0 : known->count;
}

std::vector<std::string> FaultCounter::sentences() const {
  std::vector<std::string> sentences;
  for (const Fault& fault : faults_) {
    std::string text = fmt::format("{}: {}", file_, fault.name);
    const bool again = fault.count > 1;
    if (again) text += fmt::format(": {} times", fault.count);
    if (fault.first > 0) text += fmt::format("{} {} {}", again ? ", first in" : " in", unit_, fault.first);
    if (!fault.key.empty()) text += fmt::format(": {}", fault.key);
    if (!fault.value.empty()) text += fmt::format(" = {}", fault.value);
    sentences.push_back(std::move(text));
  }
  return sentences;
}

}  // namespace trivela::evaluator::imports
