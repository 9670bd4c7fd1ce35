#include "evaluator/sessions/same_match.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace trivela::evaluator {
namespace {

using Place = std::uint32_t;

/// Whether `a` says more than `b` of what both recorded: it has more rows, or was closed.
bool more_complete(const ComparedSession& a, const ComparedSession& b) {
  return std::pair(a.row_count, a.closed_utc_ns.has_value()) > std::pair(b.row_count, b.closed_utc_ns.has_value());
}

/// Sets of sessions that are joined two by two.
class Joined {
 public:
  explicit Joined(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), Place{0}); }
  Place of(Place a) const { return parent_[a] == a ? a : of(parent_[a]); }
  void join(Place a, Place b) { parent_[std::max(of(a), of(b))] = std::min(of(a), of(b)); }

 private:
  std::vector<Place> parent_;
};

bool may_be_one(const ComparedSession& a, const ComparedSession& b) {
  return !a.is_replay && !b.is_replay && !(a.imported && b.imported) && !a.match_id && !b.match_id &&
         a.simulated == b.simulated && a.lockstep == b.lockstep &&
         (!a.simulated || (a.seed == b.seed && a.setup.world == b.setup.world));
}

void join_by_kicks(const std::vector<ComparedSession>& sessions, const std::vector<KickRecording>& kicks,
                   Joined& joined) {
  std::map<std::tuple<int, std::int64_t, std::int64_t>, Place> first;
  for (const KickRecording& kick : kicks) {
    const auto [known, added] = first.try_emplace(kick.kick(), kick.session);
    if (!added && may_be_one(sessions[known->second], sessions[kick.session])) joined.join(known->second, kick.session);
  }
}

void join_by_continuing(const std::vector<ComparedSession>& sessions, Joined& joined) {
  std::map<std::string, Place> by_uuid;
  for (Place i = 0; i < sessions.size(); ++i) by_uuid[sessions[i].uuid] = i;
  for (Place i = 0; i < sessions.size(); ++i) {
    const auto before = by_uuid.find(sessions[i].continues_uuid);
    if (before != by_uuid.end()) joined.join(before->second, i);
  }
}

/// Robots that kicked in a session between two instants.
std::set<int> kickers(Place session, const std::vector<KickRecording>& kicks, std::int64_t from_utc_ns,
                      std::int64_t to_utc_ns) {
  std::set<int> robots;
  for (const KickRecording& kick : kicks) {
    if (kick.session == session && kick.utc_ns >= from_utc_ns && kick.utc_ns <= to_utc_ns) robots.insert(kick.robot_id);
  }
  return robots;
}

/// Sessions that have no kick in common: had the two recorded the same, they would have.
bool contradict(const std::vector<ComparedSession>& sessions, const std::vector<KickRecording>& kicks, Place a,
                Place b) {
  const std::int64_t from_utc_ns = std::max(sessions[a].started_utc_ns, sessions[b].started_utc_ns);
  const std::int64_t to_utc_ns = std::min(sessions[a].ended_utc_ns, sessions[b].ended_utc_ns);
  const std::set<int> others = kickers(b, kicks, from_utc_ns, to_utc_ns);
  return std::ranges::any_of(kickers(a, kicks, from_utc_ns, to_utc_ns),
                             [&](int robot_id) { return others.contains(robot_id); });
}

void join_by_time(const std::vector<ComparedSession>& sessions, const std::vector<KickRecording>& kicks,
                  Joined& joined) {
  std::vector<Place> steady;
  for (Place i = 0; i < sessions.size(); ++i) {
    if (!sessions[i].lockstep && !sessions[i].is_replay) steady.push_back(i);
  }
  std::ranges::stable_sort(steady, {}, [&](Place i) { return sessions[i].started_utc_ns; });
  for (auto a = steady.begin(); a != steady.end(); ++a) {
    for (auto b = a + 1; b != steady.end() && sessions[*b].started_utc_ns < sessions[*a].ended_utc_ns; ++b) {
      if (joined.of(*a) == joined.of(*b) || !may_be_one(sessions[*a], sessions[*b])) continue;
      if (!contradict(sessions, kicks, *a, *b)) joined.join(*a, *b);
    }
  }
}

/// Of matches in lockstep with the same rows one counts.
void leave_out_repetitions(std::vector<ComparedSession>& sessions) {
  using SameRows = std::tuple<bool, std::int64_t, std::string, std::string, std::string, std::optional<std::int64_t>>;
  std::map<SameRows, Place> best;
  std::set<std::uint32_t> again;  // plays, all of whose recordings are left out
  for (Place i = 0; i < sessions.size(); ++i) {
    ComparedSession& session = sessions[i];
    if (!session.lockstep || !session.seed || session.is_replay) continue;
    const SameRows key{session.match_id.has_value(), *session.seed, session.arm,
                       session.config_sha256,        session.table, session.calibration_id};
    const auto [place, first] = best.try_emplace(key, i);
    if (first || sessions[place->second].play == session.play) continue;
    const bool better = more_complete(session, sessions[place->second]);
    again.insert((better ? sessions[place->second] : session).play);
    if (better) place->second = i;
  }
  for (ComparedSession& session : sessions) session.counts = session.counts && !again.contains(session.play);
}

/// Nor does a half count twice that two matches in lockstep have alike: the possessions of a half are drawn from the
/// seed and the number of the half.
void leave_out_repeated_halves(std::vector<ComparedSession>& sessions) {
  using SameHalf = std::tuple<std::int64_t, std::uint32_t, std::uint32_t, int, std::string>;
  std::map<SameHalf, Place> best;
  std::set<std::pair<std::uint32_t, int>> again;  // play and half
  for (Place i = 0; i < sessions.size(); ++i) {
    const ComparedSession& session = sessions[i];
    if (!session.lockstep || !session.seed || session.match_id || session.is_replay || !session.counts) continue;
    for (const auto& [half, policies] : session.in_charge) {
      const auto [place, first] =
          best.try_emplace({*session.seed, session.setup.world, session.setup.settings, half, policies}, i);
      const ComparedSession& other = sessions[place->second];
      if (first || other.play == session.play) continue;
      const bool better = more_complete(session, other);
      again.emplace((better ? other : session).play, half);
      if (better) place->second = i;
    }
  }
  for (const auto& [play, half] : again) {
    for (ComparedSession& session : sessions)
      if (session.play == play) session.halves_left_out.insert(half);
  }
}

void leave_out_replays(std::vector<ComparedSession>& sessions) {
  if (std::ranges::all_of(sessions, &ComparedSession::is_replay)) return;
  for (ComparedSession& session : sessions) session.counts = session.counts && !session.is_replay;
}

}  // namespace

void find_plays(std::vector<ComparedSession>& sessions, const std::vector<KickRecording>& kicks) {
  Joined joined(sessions.size());
  join_by_kicks(sessions, kicks, joined);
  join_by_continuing(sessions, joined);
  join_by_time(sessions, kicks, joined);
  for (Place i = 0; i < sessions.size(); ++i) sessions[i].play = joined.of(i);
  leave_out_repetitions(sessions);
  leave_out_repeated_halves(sessions);
  leave_out_replays(sessions);
}

std::vector<std::size_t> kicks_left_out(const std::vector<ComparedSession>& sessions,
                                        const std::vector<KickRecording>& kicks) {
  std::map<std::tuple<Place, int, std::int64_t>, std::size_t> best;  // play, robot, kick
  std::vector<std::size_t> left_out;
  for (std::size_t i = 0; i < kicks.size(); ++i) {
    const ComparedSession& session = sessions[kicks[i].session];
    if (!session.counts || session.halves_left_out.contains(kicks[i].half)) {
      left_out.push_back(i);
      continue;
    }
    const auto [place, first] = best.try_emplace({session.play, kicks[i].robot_id, kicks[i].kick_id}, i);
    if (first) continue;
    const KickRecording& other = kicks[place->second];
    const auto said = [](const KickRecording& kick) { return std::pair(kick.labelled_utc_ns, kick.words); };
    const bool better =
        said(kicks[i]) != said(other) ? said(kicks[i]) > said(other) : more_complete(session, sessions[other.session]);
    left_out.push_back(better ? std::exchange(place->second, i) : i);
  }
  return left_out;
}

}  // namespace trivela::evaluator
