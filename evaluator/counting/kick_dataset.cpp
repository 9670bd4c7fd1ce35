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

bool put_first(KickDataset& book, const std::string& baseline) {
  const auto found = std::ranges::find(book.groups, baseline);
  if (found == book.groups.end()) return false;
  const auto place = static_cast<std::uint32_t>(found - book.groups.begin());
  const auto moved = [&](std::uint32_t group) { return group == place ? 0 : group < place ? group + 1 : group; };
  std::rotate(book.groups.begin(), found, found + 1);
  if (!book.planned_shares.empty()) {
    const auto share = book.planned_shares.begin() + place;
    std::rotate(book.planned_shares.begin(), share, share + 1);
  }
  for (Opportunity& opportunity : book.opportunities) opportunity.group = moved(opportunity.group);
  decltype(book.minutes) minutes;
  for (const auto& [key, value] : book.minutes) minutes[{moved(key.first), key.second}] = value;
  book.minutes = std::move(minutes);
  return true;
}

}  // namespace trivela::evaluator
