#include "log/merge/kick_conflicts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace trivela::log {
namespace {

constexpr std::int64_t kCounter = (std::int64_t{1} << 40) - 1;  // of a kick_id

}  // namespace

std::string KickConflict::line() const {
  std::vector<std::string> sayings;
  for (const Said& one : said) sayings.push_back(fmt::format("{} says {}", one.source, one.what));
  return fmt::format("kick {}:{} ({}): {}", robot_id, kick_id & kCounter, about, fmt::join(sayings, ", "));
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
        "SELECT k.robot_id, k.kick_id, k.t_ns, s.seed, iif(s.match_id IS NULL, 0, k.session_id), k.policy, k.accepted, "
        "k.refusal, k.outcome, k.hand_outcome FROM labelled_kicks AS k JOIN sessions AS s ON s.session_id = "
        "k.session_id",
        [&](int robot_id, std::int64_t kick_id, std::int64_t t_ns, std::optional<std::int64_t> seed,
            std::int64_t of_experiment, const std::string& policy, std::optional<bool> accepted,
            const std::optional<std::string>& refusal, const std::optional<std::string>& outcome,
            const std::optional<std::string>& by_hand) {
          const Kick kick{robot_id, kick_id, t_ns, seed, of_experiment};
          say(kick, "policy", source, policy);
          if (accepted) say(kick, "driver", source, *accepted ? "kicked" : "refused: " + refusal.value_or("unknown"));
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
  for (const auto& [kick, sayings] : kicks_) {
    for (const auto& [about, said] : sayings)
      if (said.size() > 1) conflicts.push_back({std::get<0>(kick), std::get<1>(kick), std::get<2>(kick), about, said});
  }
  return conflicts;
}

}  // namespace trivela::log
