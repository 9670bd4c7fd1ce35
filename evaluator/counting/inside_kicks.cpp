#include "evaluator/counting/inside_kicks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

namespace trivela::evaluator {
namespace {

std::string line(std::span<const NamedInside> groups, const char* what, SaidOfInside InsideKicks::*said, bool truth) {
  std::vector<std::string> parts;
  for (const NamedInside& group : groups) {
    const SaidOfInside& of = group.inside.*said;
    if ((truth ? of.truth : of.observed) == 0) continue;
    parts.push_back(
        fmt::format("{} {} of {}", group.name, truth ? of.truth_yes : of.observed_yes, truth ? of.truth : of.observed));
  }
  if (parts.empty()) return "";
  return fmt::format("  {}, of those inside, {}: {}\n", what, truth ? "by the simulator's truth" : "as observed",
                     fmt::join(parts, ", "));
}

Json share(std::int64_t yes, std::int64_t of, const char* what) {
  return of > 0 ? Json{{what, yes}, {"of", of}} : Json();
}

}  // namespace

std::string inside_lines(std::span<const NamedInside> groups) {
  constexpr const char* kBounced = "bounced before the line";
  std::string text =
      line(groups, kBounced, &InsideKicks::bounced, false) + line(groups, kBounced, &InsideKicks::bounced, true);
  if (std::ranges::none_of(groups, [](const NamedInside& group) { return group.inside.saved.any(); })) return text;
  constexpr const char* kSaved = "saved by a keeper";
  text += line(groups, kSaved, &InsideKicks::saved, false);
  return text + line(groups, kSaved, &InsideKicks::saved, true);
}

Json said_json(const SaidOfInside& said, const char* what) {
  return {{"observed", share(said.observed_yes, said.observed, what)},
          {"truth", share(said.truth_yes, said.truth, what)}};
}

}  // namespace trivela::evaluator
