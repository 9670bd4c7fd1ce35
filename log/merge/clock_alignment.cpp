#include "log/merge/clock_alignment.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <queue>
#include <set>
#include <tuple>
#include <utility>

namespace trivela::log {
namespace {

using SessionPlace = std::size_t;

constexpr std::int64_t kWindow_ns = 10'000'000'000;    // the best measurement of so long counts
constexpr std::int64_t kOneClock_ns = 500'000'000;     // UTC of one clock differs by no more, even where it was set
constexpr std::int64_t kSlack_ns = 10'000'000'000;     // a measurement may be older or younger than the recording
constexpr std::int64_t kPlausible_ns = 1'000'000'000;  // of the most plausible session's UTC

/// Measurements between the clocks of two sessions, by the first one's.
struct Measured {
  std::int64_t t_ns = 0;
  std::int64_t offset_ns = 0;  // the other clock minus this one
  std::int64_t error_ns = 0;
};

using Edges = std::map<std::pair<SessionPlace, SessionPlace>, std::vector<Measured>>;

std::int64_t drift_ns(std::int64_t span_ns) {
  return static_cast<std::int64_t>(std::ceil(kLargestDrift * static_cast<double>(std::max<std::int64_t>(span_ns, 0))));
}

/// Sessions of the other participant that ran at that instant of its clock: those of the start of its machine whose UTC
/// is nearest to what the measuring session's was.
std::vector<SessionPlace> recorded_sessions(const std::vector<ClockedSession>& sessions, const ClockOffset& offset,
                                            const ClockedSession& by) {
  std::vector<std::pair<std::int64_t, SessionPlace>> found;
  const std::int64_t there_t_ns = offset.t_ns + offset.offset_ns;
  for (SessionPlace i = 0; i < sessions.size(); ++i) {
    const ClockedSession& other = sessions[i];
    if (other.robot_id != offset.other_robot_id) continue;
    if (there_t_ns < other.started_t_ns - kSlack_ns || there_t_ns > other.ended_t_ns + kSlack_ns) continue;
    const std::int64_t apart_ns = offset.offset_ns + other.realtime_offset_ns - by.realtime_offset_ns;
    found.emplace_back(std::abs(apart_ns), i);
  }
  std::ranges::sort(found);
  std::vector<SessionPlace> places;
  for (const auto& [apart_ns, place] : found) {
    if (apart_ns <= found.front().first + kPlausible_ns) places.push_back(place);
  }
  return places;
}

Edges edges_of(const std::vector<ClockedSession>& sessions, const std::vector<ClockOffset>& offsets) {
  std::map<std::int64_t, SessionPlace> by_id;
  for (SessionPlace i = 0; i < sessions.size(); ++i) by_id[sessions[i].session_id] = i;
  Edges edges;
  for (const ClockOffset& offset : offsets) {
    const auto by = by_id.find(offset.session_id);
    if (by == by_id.end() || sessions[by->second].robot_id != offset.robot_id) continue;
    for (const SessionPlace other : recorded_sessions(sessions, offset, sessions[by->second])) {
      if (other == by->second) continue;
      edges[{by->second, other}].push_back({offset.t_ns, offset.offset_ns, offset.error_ns});
      edges[{other, by->second}].push_back({offset.t_ns + offset.offset_ns, -offset.offset_ns, offset.error_ns});
    }
  }
  for (auto& [pair, measured] : edges) {
    std::ranges::sort(measured, {}, [](const Measured& m) { return std::tuple(m.t_ns, m.error_ns, m.offset_ns); });
  }
  return edges;
}

/// The best measurement of each window, by time.
std::vector<Measured> best_of(const std::vector<Measured>& measured) {
  std::vector<Measured> best;
  std::int64_t window = 0;
  for (const Measured& m : measured) {
    const std::int64_t its_window = m.t_ns / kWindow_ns;
    if (best.empty() || its_window != window) {
      best.push_back(m);
      window = its_window;
    } else if (m.error_ns < best.back().error_ns) {
      best.back() = m;
    }
  }
  return best;
}

std::int64_t error_at(const std::vector<ClockSegment>& segments, std::int64_t t_ns) {
  auto next = std::ranges::upper_bound(segments, t_ns, {}, &ClockSegment::from_t_ns);
  return (next == segments.begin() ? next : next - 1)->error_ns;
}

/// A session's way to UTC over another one that has it.
std::vector<ClockSegment> over(const ClockedSession& session, const std::vector<Measured>& measured,
                               const std::vector<ClockSegment>& there) {
  std::vector<ClockSegment> points;
  for (const Measured& m : best_of(measured)) {
    const std::int64_t there_t_ns = m.t_ns + m.offset_ns;
    points.push_back(
        {m.t_ns, m.offset_ns + utc_offset_at(there, there_t_ns), 0.0, m.error_ns + error_at(there, there_t_ns)});
  }
  std::vector<ClockSegment> segments;
  const ClockSegment& first = points.front();
  if (session.started_t_ns < first.from_t_ns) {
    const std::int64_t more_ns = drift_ns(first.from_t_ns - session.started_t_ns);
    segments.push_back({session.started_t_ns, first.utc_offset_ns, 0.0, first.error_ns + more_ns});
  }
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    ClockSegment segment = points[i];
    const auto length_ns = static_cast<double>(points[i + 1].from_t_ns - segment.from_t_ns);
    segment.rate = static_cast<double>(points[i + 1].utc_offset_ns - segment.utc_offset_ns) / length_ns;
    segment.error_ns = std::max(segment.error_ns, points[i + 1].error_ns);
    segments.push_back(segment);
  }
  ClockSegment last = points.back();
  last.error_ns += drift_ns(session.ended_t_ns - last.from_t_ns);
  segments.push_back(last);
  return segments;
}

std::int64_t largest_error(const std::vector<ClockSegment>& segments) {
  return std::ranges::max(segments, {}, &ClockSegment::error_ns).error_ns;
}

/// The same clock in another session, which may begin before or end after what was measured.
std::vector<ClockSegment> longer(std::vector<ClockSegment> segments, const ClockedSession& of,
                                 const ClockedSession& other) {
  segments.front().error_ns += drift_ns(of.started_t_ns - other.started_t_ns);
  segments.back().error_ns += drift_ns(other.ended_t_ns - of.ended_t_ns);
  return segments;
}

/// From the reference on to whoever is joined with the smallest error.
class Spread {
 public:
  Spread(const std::vector<ClockedSession>& sessions, const Edges& edges) : sessions_(sessions), edges_(edges) {}

  Alignment from(SessionPlace root) {
    const ClockedSession& reference = sessions_[root];
    reference_robot_ = reference.robot_id;
    offer(root, {{reference.started_t_ns, reference.realtime_offset_ns, 0.0, 0}});
    while (!waiting_.empty()) {
      const SessionPlace place = std::get<1>(waiting_.top());
      waiting_.pop();
      if (done_.insert(place).second) go_on(place);
    }
    Alignment alignment{reference.robot_id, reference.uuid, {}};
    for (const auto& [place, segments] : known_)
      alignment.sessions.push_back({sessions_[place].session_id, segments, largest_error(segments)});
    return alignment;
  }

 private:
  void offer(SessionPlace place, std::vector<ClockSegment> segments) {
    const std::int64_t error_ns = largest_error(segments);
    const auto there = known_.find(place);
    if (there != known_.end() && largest_error(there->second) <= error_ns) return;
    known_[place] = std::move(segments);
    waiting_.emplace(error_ns, place);
  }

  void go_on(SessionPlace place) {
    const std::vector<ClockSegment> here = known_.at(place);
    for (SessionPlace other = 0; other < sessions_.size(); ++other) {
      if (done_.contains(other)) continue;
      const std::int64_t apart_ns = sessions_[other].realtime_offset_ns - sessions_[place].realtime_offset_ns;
      if (sessions_[other].robot_id == sessions_[place].robot_id && std::abs(apart_ns) <= kOneClock_ns)
        offer(other,
              sessions_[other].robot_id == reference_robot_ ? here : longer(here, sessions_[place], sessions_[other]));
      const auto measured = edges_.find({other, place});
      if (measured != edges_.end()) offer(other, over(sessions_[other], measured->second, here));
    }
  }

  using Waiting = std::pair<std::int64_t, SessionPlace>;
  const std::vector<ClockedSession>& sessions_;
  const Edges& edges_;
  int reference_robot_ = 0;
  std::map<SessionPlace, std::vector<ClockSegment>> known_;
  std::set<SessionPlace> done_;
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> waiting_;
};

}  // namespace

std::int64_t utc_offset_at(const std::vector<ClockSegment>& segments, std::int64_t t_ns) {
  auto next = std::ranges::upper_bound(segments, t_ns, {}, &ClockSegment::from_t_ns);
  const ClockSegment& segment = *(next == segments.begin() ? next : next - 1);
  return segment.utc_offset_ns + std::llround(segment.rate * static_cast<double>(t_ns - segment.from_t_ns));
}

Alignment align_clocks(const std::vector<ClockedSession>& sessions, const std::vector<ClockOffset>& offsets,
                       std::optional<int> reference_robot) {
  if (offsets.empty()) return {};
  const Edges edges = edges_of(sessions, offsets);
  std::map<int, SessionPlace> first_of;  // earliest session of each participant
  for (SessionPlace i = 0; i < sessions.size(); ++i) {
    const auto [place, added] = first_of.try_emplace(sessions[i].robot_id, i);
    const auto utc_ns = [&](SessionPlace at) { return sessions[at].started_t_ns + sessions[at].realtime_offset_ns; };
    if (!added && utc_ns(i) < utc_ns(place->second)) place->second = i;
  }
  std::optional<std::pair<std::pair<std::int64_t, std::int64_t>, Alignment>> best;
  for (const auto& [robot_id, root] : first_of) {
    if (reference_robot && robot_id != *reference_robot) continue;
    Alignment alignment = Spread(sessions, edges).from(root);
    std::int64_t errors_ns = 0;
    for (const AlignedSession& session : alignment.sessions) errors_ns += session.error_ns;
    const std::pair score(-static_cast<std::int64_t>(alignment.sessions.size()), errors_ns);
    if (!best || score < best->first) best.emplace(score, std::move(alignment));
  }
  return best ? best->second : Alignment{};
}

}  // namespace trivela::log
