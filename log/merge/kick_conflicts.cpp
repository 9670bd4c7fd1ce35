#include "log/merge/kick_conflicts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace trivela::log {
namespace {

constexpr std::int64_t kCounter = (std::int64_t{1} << 40) - 1;  // of a kick_id

}  // namespace

std::string KickConflict::line() const {
  std::vector<std::string> claims;
  for (const Said& one : said) claims.push_back(fmt::format("{} says {}", one.source, one.what));
  return fmt::format("kick {}:{} ({}): {}", robot_id, kick_id & kCounter, about, fmt::join(claims, ", "));
}

void KickConflicts::say(const Kick& kick, const std::string& about, const std::string& source,
                        const std::string& what) {
  auto& said = kicks_[kick][about];
  if (std::ranges::find(said, what, &KickConflict::Said::what) == said.end()) said.push_back({source, what});
}

void KickConflicts::add(const MergeSource& file) {
  if (file.reader() == nullptr) return;
  const std::string source = file.path().filename().string();
  const auto ask = [&] {
    file.reader()->query(
        "SELECT k.robot_id, k.kick_id, k.t_ns, s.seed, iif(s.match_id IS NULL, 0, k.session_id) AS of_experiment, "
        "k.policy, "
        "k.accepted, k.refusal, k.outcome, k.hand_label FROM labelled_kicks AS k JOIN sessions AS s ON s.session_id "
        "= "
        "k.session_id",
        [&](const NamedCells& row) {
          const auto accepted = row.find<bool>("accepted");
          const auto outcome = row.find<std::string>("outcome");
          const auto by_hand = row.find<std::string>("hand_label");
          const Kick kick{row.get<int>("robot_id"), row.get<std::int64_t>("kick_id"), row.get<std::int64_t>("t_ns"),
                          row.find<std::int64_t>("seed"), row.get<std::int64_t>("of_experiment")};
          say(kick, "policy", source, row.get<std::string>("policy"));
          if (accepted)
            say(kick, "driver", source,
                *accepted ? "kicked" : "refused: " + row.find<std::string>("refusal").value_or("unknown"));
          if (outcome && *outcome != "unknown") say(kick, "outcome", source, *outcome);
          if (by_hand) say(kick, "label", source, *by_hand);
        });
  };
  try {
    ask();
  } catch (const std::runtime_error&) {
    if (file.damage().empty()) throw;
  }
}

std::vector<KickConflict> KickConflicts::conflicts() const {
  std::vector<KickConflict> conflicts;
  for (const auto& [kick, claims] : kicks_) {
    for (const auto& [about, said] : claims)
      if (said.size() > 1) conflicts.push_back({std::get<0>(kick), std::get<1>(kick), std::get<2>(kick), about, said});
  }
  return conflicts;
}

}  // namespace trivela::log
