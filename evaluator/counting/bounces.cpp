#include "evaluator/counting/bounces.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

namespace trivela::evaluator {
namespace {

std::string line(std::span<const NamedBounces> groups, const char* who, std::int64_t Bounces::*of,
                 std::int64_t Bounces::*bounced) {
  std::vector<std::string> parts;
  for (const NamedBounces& group : groups) {
    if (group.bounces.*of > 0)
      parts.push_back(fmt::format("{} {} of {}", group.name, group.bounces.*bounced, group.bounces.*of));
  }
  if (parts.empty()) return "";
  return fmt::format("  bounced before the line, of those inside, {}: {}\n", who, fmt::join(parts, ", "));
}

Json share(std::int64_t bounced, std::int64_t of) { return of > 0 ? Json{{"bounced", bounced}, {"of", of}} : Json(); }

}  // namespace

std::string bounce_lines(std::span<const NamedBounces> groups) {
  return line(groups, "as observed", &Bounces::observed, &Bounces::observed_bounced) +
         line(groups, "by the simulator's truth", &Bounces::truth, &Bounces::truth_bounced);
}

Json bounces_json(const Bounces& bounces) {
  return {{"observed", share(bounces.observed_bounced, bounces.observed)},
          {"truth", share(bounces.truth_bounced, bounces.truth)}};
}

}  // namespace trivela::evaluator
