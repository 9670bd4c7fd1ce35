#include "evaluator/report/log_sessions.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "evaluator/log/value.hpp"
#include "evaluator/metrics/compared_sessions.sql.hpp"

namespace trivela::evaluator {
namespace {

using SessionCells = std::span<const log::Value>;

std::map<std::string, SessionSetup> setups_of(const log::Reader& reader, SetupBook& book) {
  std::map<std::string, SessionSetup> setups;
  reader.query("SELECT DISTINCT config_sha256, text FROM sessions JOIN texts ON sha256 = config_sha256",
               [&](SessionCells row) { setups[log::text_if_any(row[0])] = book.of(log::text_if_any(row[1])); });
  return setups;
}

ComparedSession session_of(SessionCells row, const std::map<std::string, SessionSetup>& setups) {
  ComparedSession session;
  session.session_id = log::integer(row[0]);
  session.started_utc_ns = log::integer(row[1]);
  session.closed_utc_ns = log::integer_if_any(row[2]);
  session.seed = log::integer_if_any(row[3]);
  session.scenario = log::text_if_any(row[4]);
  session.simulated = log::integer(row[5]) != 0;
  session.arm = log::text_if_any(row[6]);
  session.table = log::text_if_any(row[7]);
  session.match_id = log::integer_if_any(row[8]);
  session.config_sha256 = log::text_if_any(row[9]);
  session.calibration_id = log::integer_if_any(row[10]);
  if (const auto setup = setups.find(session.config_sha256); setup != setups.end()) session.setup = setup->second;
  return session;
}

}  // namespace

SessionPlaces SessionBook::add(const log::Reader& reader, const std::string& name) {
  SessionPlaces fresh;
  std::int64_t again = 0, open = 0, replayed = 0;
  const auto setups = setups_of(reader, setups_);
  reader.query(kComparedSessionsSql, [&](SessionCells row) {
    ComparedSession session = session_of(row, setups);
    if (!known_.insert(session.session_id).second) {
      ++again;
      return;
    }
    const bool numbered = session.match_id && session.seed;
    if (numbered &&
        !played_.insert({*session.seed, session.arm, session.config_sha256, session.table, session.calibration_id})
             .second) {
      ++replayed;
      return;
    }
    open += session.closed_utc_ns ? 0 : 1;
    fresh[session.session_id] = static_cast<std::uint32_t>(logged_.sessions.size());
    logged_.sessions.push_back(std::move(session));
  });
  add_remarks(reader, name, again, replayed, open);
  return fresh;
}

void SessionBook::add_remarks(const log::Reader& reader, const std::string& name, std::int64_t again,
                              std::int64_t replayed, std::int64_t open) {
  const auto remark = [&](std::int64_t n, const char* what) {
    if (n > 0) logged_.remarks.push_back(fmt::format("{}: {} {}", name, n, what));
  };
  remark(again, "of its sessions stand in an earlier log, too, and count once");
  remark(replayed, "of its matches were played before with the same seed, arm and configuration, and count once");
  if (const auto doubt = reader.doubt(); doubt && !reader.verification().compared && reader.verification().rows > 0)
    logged_.remarks.push_back(fmt::format("{}: {}", name, *doubt));
  remark(open, "sessions were not closed, their last kicks may be missing");
  reader.query("SELECT matches_done, matches FROM experiments WHERE matches_done < matches", [&](SessionCells row) {
    logged_.remarks.push_back(fmt::format("{}: the experiment is not finished, {} of {} matches are there", name,
                                          log::integer(row[0]), log::integer(row[1])));
  });
}

void SessionBook::number_matches() {
  using Numbered = std::pair<std::string, std::int64_t>;  // scenario, and seed or match
  std::map<std::pair<Numbered, std::uint32_t>, std::uint32_t> simulated;
  std::map<Numbered, std::uint32_t> first_world;
  std::set<std::string> of_several_worlds;
  std::int64_t last_end_utc_ns = 0;
  std::optional<std::uint32_t> last_real;
  std::vector<std::size_t> order(logged_.sessions.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return logged_.sessions[i].started_utc_ns; });
  for (const std::size_t i : order) {
    ComparedSession& session = logged_.sessions[i];
    if (session.simulated && (session.match_id || session.seed)) {
      const Numbered key{session.scenario, session.seed ? *session.seed : *session.match_id};
      const auto [place, added] = simulated.try_emplace({key, session.setup.world}, logged_.matches);
      logged_.matches += added ? 1 : 0;
      session.match = place->second;
      if (first_world.try_emplace(key, session.setup.world).first->second != session.setup.world)
        of_several_worlds.insert(session.scenario);
      continue;
    }
    if (session.simulated || !last_real || session.started_utc_ns >= last_end_utc_ns) {
      last_real = logged_.matches++;
      last_end_utc_ns = session.started_utc_ns;
    }
    session.match = *last_real;
    last_end_utc_ns = std::max(last_end_utc_ns, session.closed_utc_ns.value_or(session.started_utc_ns));
  }
  for (const std::string& scenario : of_several_worlds)
    logged_.remarks.push_back(fmt::format(
        "scenario '{}' is not the same in all sessions: matches of the same seed are not the same opportunities",
        scenario));
}

}  // namespace trivela::evaluator
