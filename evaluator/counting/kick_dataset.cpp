#include "evaluator/counting/kick_dataset.hpp"

#include <algorithm>
#include <array>

namespace trivela::evaluator {
namespace {

constexpr std::array kDesigns{std::pair{Design::kBeforeAfter, "before_after"},
                              std::pair{Design::kAlternating, "alternating"},
                              std::pair{Design::kRandomised, "randomised"}, std::pair{Design::kPaired, "paired"}};

}  // namespace

const char* label(Design design) {
  return std::ranges::find(kDesigns, design, [](auto& d) { return d.first; })->second;
}

std::optional<Design> design_of(const std::string& label) {
  for (const auto& [design, name] : kDesigns) {
    if (label == name) return design;
  }
  return std::nullopt;
}

std::uint32_t place_of(std::vector<std::string>& names, const std::string& name) {
  const auto found = std::ranges::find(names, name);
  const auto place = static_cast<std::uint32_t>(found - names.begin());
  if (found == names.end()) names.push_back(name);
  return place;
}

const std::vector<std::string>& distance_bins() {
  static const std::vector<std::string> bins = {"under 3 m", "3 to 4 m", "4 to 5 m", "5 to 6 m", "6 m or more"};
  return bins;
}

std::uint32_t distance_bin(double distance_m) {
  return static_cast<std::uint32_t>(std::clamp(static_cast<int>(distance_m) - 2, 0, 4));
}

bool put_first(KickDataset& dataset, const std::string& baseline) {
  const auto found = std::ranges::find(dataset.groups, baseline);
  if (found == dataset.groups.end()) return false;
  const auto place = static_cast<std::uint32_t>(found - dataset.groups.begin());
  const auto moved = [&](std::uint32_t group) { return group == place ? 0 : group < place ? group + 1 : group; };
  std::rotate(dataset.groups.begin(), found, found + 1);
  if (!dataset.planned_shares.empty()) {
    const auto share = dataset.planned_shares.begin() + place;
    std::rotate(dataset.planned_shares.begin(), share, share + 1);
  }
  for (Opportunity& opportunity : dataset.opportunities) opportunity.group = moved(opportunity.group);
  decltype(dataset.minutes) minutes;
  for (const auto& [key, value] : dataset.minutes) minutes[{moved(key.first), key.second}] = value;
  dataset.minutes = std::move(minutes);
  return true;
}

}  // namespace trivela::evaluator
