#include "evaluator/sessions/recording_gaps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "evaluator/metrics/silences.sql.hpp"
#include "evaluator/metrics/unrecorded_orders.sql.hpp"

namespace trivela::evaluator {
namespace {

constexpr std::size_t kMostLines = 8;

std::string sentence(const RecordedSilence& silence) {
  const std::string what =
      fmt::format("{} of robot {} silent from {:.2f} s to ", silence.stream, silence.robot_id, silence.from_s());
  if (const auto to_s = silence.to_s())
    return what + fmt::format("{:.2f} s ({:.2f} s)", *to_s, *to_s - silence.from_s());
  return what + (silence.counts ? "the end" : "the end, as all of that robot");
}

std::string counted(std::int64_t orders, std::int64_t kicks) {
  return fmt::format("{} {}, {} of them {}", orders, orders == 1 ? "order" : "orders", kicks,
                     kicks == 1 ? "a kick" : "kicks");
}

std::string before(const UnrecordedOrders& o) {
  const std::string what = counted(o.orders_before, o.kicks_before);
  if (!o.continues) return fmt::format("robot {}: before this log began its driver had handled {}", o.robot_id, what);
  return fmt::format(
      "robot {}: between the session that this one continues and this one its driver handled {}{}: in no log{}",
      o.robot_id, o.restarted_before ? "at least " : "", what,
      o.restarted_before ? "; it was started again meanwhile" : "");
}

using Stretch = std::pair<std::int64_t, std::int64_t>;  // from, to [ns]

double covered_s(std::vector<Stretch> stretches) {
  std::ranges::sort(stretches);
  std::int64_t covered_ns = 0, end_ns = 0;
  for (const auto& [from_ns, to_ns] : stretches) {
    const std::int64_t begin_ns = covered_ns == 0 ? from_ns : std::max(from_ns, end_ns);
    covered_ns += std::max<std::int64_t>(to_ns - begin_ns, 0);
    end_ns = std::max(to_ns, end_ns);
  }
  return kicking::seconds(covered_ns);
}

// Calls fn(session, planned_s, half, from, to) for what the referee said of each planned session; `halves`: of each
// half that it says who was in charge of, but for replays.
void each_stretch(const log::Reader& reader, bool halves, const auto& fn) {
  const std::string columns =
      ", planned_s, min(first_t_ns) + CASE clock WHEN 'steady' THEN realtime_offset_ns ELSE 0 END, "
      "max(last_t_ns) + CASE clock WHEN 'steady' THEN realtime_offset_ns ELSE 0 END ";
  reader.query(halves ? "SELECT p.session_id, p.half" + columns +
                            "FROM (SELECT DISTINCT session_id, half FROM session_policies) AS p JOIN sessions AS s "
                            "USING (session_id) LEFT JOIN recorded_halves AS r ON r.session_id = p.session_id "
                            "AND r.half = p.half WHERE planned_s IS NOT NULL AND replays_uuid IS NULL "
                            "GROUP BY p.session_id, p.half"
                      : "SELECT s.session_id, 0" + columns +
                            "FROM sessions AS s LEFT JOIN recorded_halves AS r ON r.session_id = s.session_id "
                            "WHERE planned_s IS NOT NULL GROUP BY s.session_id ORDER BY s.started_t_ns, s.session_id",
               [&](std::int64_t session_id, int half, double planned_s, std::optional<std::int64_t> from_ns,
                   std::optional<std::int64_t> to_ns) {
                 std::optional<Stretch> stretch;
                 if (from_ns && to_ns) stretch.emplace(*from_ns, *to_ns);
                 fn(session_id, half, planned_s, stretch);
               });
}

}  // namespace

std::optional<double> RecordedSilence::to_s() const {
  if (!to_t_ns) return std::nullopt;
  return kicking::seconds(*to_t_ns - started_t_ns);
}

std::vector<RecordedSilence> silences_of(const log::Reader& reader) {
  using S = RecordedSilence;
  return reader.rows<S>(kSilencesSql, &S::session_id, &S::stream, &S::robot_id, &S::from_t_ns, &S::to_t_ns,
                        &S::started_t_ns, &S::counts);
}

std::vector<UnrecordedOrders> unrecorded_orders_of(const log::Reader& reader) {
  using U = UnrecordedOrders;
  return reader.rows<U>(kUnrecordedOrdersSql, &U::session_id, &U::robot_id, &U::continues, &U::restarted_before,
                        &U::orders_before, &U::kicks_before, &U::orders_within, &U::kicks_within);
}

std::vector<std::string> silence_lines(const std::vector<RecordedSilence>& silences) {
  std::vector<std::string> lines;
  for (const RecordedSilence& silence : silences) {
    if (lines.size() == kMostLines) {
      lines.push_back(fmt::format("and {} more silences (JSON has them all)", silences.size() - kMostLines));
      break;
    }
    lines.push_back(sentence(silence));
  }
  return lines;
}

std::vector<std::string> order_lines(const std::vector<UnrecordedOrders>& orders) {
  std::vector<std::string> lines;
  for (const UnrecordedOrders& o : orders) {
    if (o.orders_before > 0 || o.kicks_before > 0 || o.restarted_before) lines.push_back(before(o));
    if (o.orders_within == 0 && o.kicks_within == 0) continue;
    lines.push_back(
        fmt::format("robot {}: while this log was recorded its driver handled {} that the log has no receipt of",
                    o.robot_id, counted(o.orders_within, o.kicks_within)));
  }
  return lines;
}

std::vector<PlayedLength> played_lengths(std::span<const log::Reader* const> logs,
                                         const std::vector<ComparedSession>& sessions) {
  std::map<std::int64_t, std::uint32_t> play_of;
  for (const ComparedSession& session : sessions) play_of[session.session_id] = session.play;
  std::map<std::uint32_t, std::size_t> places;  // of the plays
  std::vector<PlayedLength> lengths;
  std::vector<std::vector<Stretch>> received;
  // The halves that a session says who was in charge of are those that were planned; a replay's are as long as they
  // were.
  std::map<std::pair<std::size_t, int>, std::vector<Stretch>> halves;  // by place of the length
  for (const log::Reader* const reader : logs) {
    each_stretch(*reader, false, [&](std::int64_t session_id, int, double planned_s, const auto& stretch) {
      const auto [place, first] = places.try_emplace(play_of.at(session_id), lengths.size());
      if (first) {
        lengths.push_back({.session_id = session_id});
        received.emplace_back();
      }
      PlayedLength& length = lengths[place->second];
      length.planned_s = std::max(length.planned_s, planned_s);
      if (stretch) received[place->second].push_back(*stretch);
    });
    each_stretch(*reader, true, [&](std::int64_t session_id, int half, double, const auto& stretch) {
      std::vector<Stretch>& stretches = halves[{places.at(play_of.at(session_id)), half}];
      if (stretch) stretches.push_back(*stretch);
    });
  }
  for (std::size_t i = 0; i < lengths.size(); ++i) lengths[i].recorded_s = covered_s(std::move(received[i]));
  std::map<std::size_t, double> planned_halves;
  for (const auto& [key, stretches] : halves) planned_halves[key.first] += 1.0;
  for (auto& [key, stretches] : halves) {
    PlayedLength& length = lengths[key.first];
    const double half_s = length.planned_s / planned_halves.at(key.first);
    if (covered_s(std::move(stretches)) < half_s - 0.5) length.half_missing = true;
  }
  return lengths;
}

std::vector<std::string> cut_short_lines(const std::vector<PlayedLength>& lengths) {
  std::vector<std::string> lines;
  for (const PlayedLength& length : lengths) {
    if (length.cut_short())
      lines.push_back(fmt::format("cut short: {:.1f} s of {:.1f} s are recorded", length.recorded_s, length.planned_s));
  }
  return lines;
}

}  // namespace trivela::evaluator
