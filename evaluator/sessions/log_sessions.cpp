#include "evaluator/sessions/log_sessions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

#include "evaluator/metrics/compared_sessions.sql.hpp"
#include "evaluator/metrics/kick_words.sql.hpp"

namespace trivela::evaluator {
namespace {

std::map<std::string, SessionSetup> setups_of(const log::Reader& reader, SetupIndex& sessions_read) {
  std::map<std::string, SessionSetup> setups;
  reader.query("SELECT DISTINCT config_sha256, text FROM sessions JOIN texts ON sha256 = config_sha256",
               [&](const std::string& sha256, const std::string& text) { setups[sha256] = sessions_read.of(text); });
  return setups;
}

std::vector<ComparedSession> sessions_of(const log::Reader& reader) {
  using S = ComparedSession;
  return reader.rows<S>(kComparedSessionsSql, &S::session_id, &S::started_utc_ns, &S::closed_utc_ns, &S::seed,
                        &S::scenario, &S::simulated, &S::arm, &S::table, &S::match_id, &S::config_sha256, &S::uuid,
                        &S::continues_uuid, &S::is_replay, &S::paired_halves, &S::lockstep, &S::ended_utc_ns,
                        &S::row_count, &S::calibration_id, &S::imported);
}

}  // namespace

SessionPlaces SessionIndex::add(const log::Reader& reader, const std::string& name) {
  reader.hold_kicks();
  const auto log = static_cast<std::uint32_t>(logs_.size());
  logs_.push_back(name);
  SessionPlaces fresh;
  std::int64_t again = 0, open = 0;
  const auto setups = setups_of(reader, setups_);
  for (ComparedSession& session : sessions_of(reader)) {
    if (!known_.insert(session.session_id).second) {
      ++again;
      continue;
    }
    if (const auto setup = setups.find(session.config_sha256); setup != setups.end()) session.setup = setup->second;
    open += session.closed_utc_ns ? 0 : 1;
    fresh[session.session_id] = static_cast<std::uint32_t>(sessions_.size());
    session.log = log;
    sessions_.push_back(std::move(session));
  }
  reader.query("SELECT session_id, half, robot_id, policy FROM session_policies ORDER BY 1, 2, 3",
               [&](std::int64_t session_id, int half, int robot_id, const std::string& policy) {
                 const auto session = fresh.find(session_id);
                 if (session == fresh.end()) return;
                 sessions_[session->second].in_charge[half] += fmt::format("{}:{} ", robot_id, policy);
               });
  reader.query(kKickWordsSql, [&](const log::NamedCells& row) {
    const auto session = fresh.find(row.get<std::int64_t>("session_id"));
    if (session != fresh.end())
      kicks_.push_back({session->second, row.get<int>("robot_id"), row.get<std::int64_t>("kick_id"),
                        row.get<std::int64_t>("t_ns"), row.get<std::int64_t>("utc_ns"), row.get<int>("words"),
                        row.get<int>("half"), row.get<std::int64_t>("labelled_utc_ns")});
  });
  note_log(reader, name, again, open);
  return fresh;
}

void SessionIndex::note_log(const log::Reader& reader, const std::string& name, std::int64_t again, std::int64_t open) {
  const auto sentence = [&](std::int64_t n, const char* one, const char* many) {
    return fmt::format("{}: {} {}", name, n, n == 1 ? one : many);
  };
  if (again > 0)
    not_counted_.push_back(sentence(again, "of its sessions stands in an earlier log, too, and counts once",
                                    "of its sessions stand in an earlier log, too, and count once"));
  if (const auto doubt = reader.doubt(); doubt && !reader.verification().compared && reader.verification().rows > 0)
    remarks_.push_back(fmt::format("{}: {}", name, *doubt));
  if (open > 0)
    remarks_.push_back(sentence(open, "session was not closed, its last kicks may be missing",
                                "sessions were not closed, their last kicks may be missing"));
  for (const auto& [session_id, notes] : import_notes_of(reader)) {
    if (!notes.empty()) remarks_.push_back(fmt::format("{}: {}", name, notes.front()));
  }
  reader.query("SELECT matches_done, matches FROM experiments WHERE matches_done < matches",
               [&](std::int64_t done, std::int64_t matches) {
                 remarks_.push_back(fmt::format("{}: the experiment is not finished, {} of {} matches are there", name,
                                                done, matches));
               });
}

void SessionIndex::settle() {
  find_plays(sessions_, kicks_);
  for (const std::size_t i : evaluator::kicks_left_out(sessions_, kicks_)) {
    const ComparedSession& session = sessions_[kicks_[i].session];
    left_out_[{kicks_[i].session, kicks_[i].robot_id, kicks_[i].kick_id}] =
        session.counts && !session.halves_left_out.contains(kicks_[i].half);
  }
  note_left_out();
  number_matches();
}

void SessionIndex::note_left_out() {
  std::map<std::string, std::int64_t> replays, repetitions, halves, twice;  // by log
  for (const ComparedSession& session : sessions_) {
    if (!session.counts) ++(session.is_replay ? replays : repetitions)[logs_[session.log]];
    halves[logs_[session.log]] += static_cast<std::int64_t>(session.halves_left_out.size());
  }
  for (const auto& [kick, of_another_recording] : left_out_)
    twice[logs_[sessions_[std::get<0>(kick)].log]] += of_another_recording ? 1 : 0;
  const auto remark = [&](const std::map<std::string, std::int64_t>& counts, const char* one, const char* many) {
    for (const auto& [name, n] : counts) {
      if (n > 0) not_counted_.push_back(fmt::format("{}: {} {}", name, n, n == 1 ? one : many));
    }
  };
  remark(repetitions, "of its matches was played before with the same seed, arm and configuration, and counts once",
         "of its matches were played before with the same seed, arm and configuration, and count once");
  remark(halves, "of its halves was played before with the same seed, settings and policy, and counts once",
         "of its halves were played before with the same seed, settings and policy, and count once");
  remark(replays, "of its sessions replays another one and is left out: its kicks were never made",
         "of its sessions replay others and are left out: their kicks were never made");
  remark(twice, "of its kicks stands in another recording of the same match, too, and counts once",
         "of its kicks stand in another recording of the same match, too, and count once");
}

void SessionIndex::refuse_replays_alone() const {
  if (sessions_.empty() || !std::ranges::all_of(sessions_, &ComparedSession::is_replay)) return;
  throw std::runtime_error(
      fmt::format("{}: a replay, whose kicks were never made, and nothing else: there is nothing to count",
                  logs_[sessions_.front().log]));
}

bool SessionIndex::counts(std::uint32_t session, int robot_id, std::int64_t kick_id) const {
  return sessions_[session].counts && !left_out_.contains({session, robot_id, kick_id});
}

std::vector<std::int64_t> SessionIndex::sessions_left_out(const SessionPlaces& places) const {
  std::vector<std::int64_t> ids;
  for (const auto& [id, place] : places) {
    if (!sessions_[place].counts) ids.push_back(id);
  }
  return ids;
}

std::vector<log::RecordedKick> SessionIndex::kicks_left_out(const SessionPlaces& places) const {
  std::vector<log::RecordedKick> kicks;
  for (const auto& [kick, counts] : left_out_) {
    const auto& [place, robot_id, kick_id] = kick;
    const std::int64_t id = sessions_[place].session_id;
    if (places.contains(id)) kicks.push_back({id, robot_id, kick_id});
  }
  return kicks;
}

void SessionIndex::number_matches() {
  using Numbered = std::pair<std::string, std::int64_t>;  // scenario, and seed or match
  std::map<std::pair<Numbered, std::uint32_t>, std::uint32_t> simulated;
  std::map<Numbered, std::uint32_t> first_world;
  std::set<std::string> of_several_worlds;
  std::int64_t last_end_utc_ns = 0;
  std::optional<std::uint32_t> last_real;
  std::map<std::uint32_t, std::uint32_t> of_play;
  std::vector<std::size_t> order(sessions_.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return sessions_[i].started_utc_ns; });
  for (const std::size_t i : order) {
    ComparedSession& session = sessions_[i];
    if (!session.counts) continue;
    if (session.simulated && (session.match_id || session.seed)) {
      const Numbered key{session.scenario, session.seed ? *session.seed : *session.match_id};
      const auto [place, added] = simulated.try_emplace({key, session.setup.world}, matches_);
      matches_ += added ? 1 : 0;
      session.match = place->second;
      if (first_world.try_emplace(key, session.setup.world).first->second != session.setup.world)
        of_several_worlds.insert(session.scenario);
      continue;
    }
    const auto known = of_play.find(session.play);
    if (known != of_play.end()) {
      last_real = known->second;
    } else if (session.simulated || session.imported || !last_real || session.started_utc_ns >= last_end_utc_ns) {
      last_real = matches_++;
      last_end_utc_ns = session.started_utc_ns;
    }
    of_play[session.play] = session.match = *last_real;
    last_end_utc_ns = std::max(last_end_utc_ns, session.ended_utc_ns);
  }
  for (const std::string& scenario : of_several_worlds)
    remarks_.push_back(fmt::format(
        "scenario '{}' is not the same in all sessions: matches of the same seed are not the same opportunities",
        scenario));
}

}  // namespace trivela::evaluator
