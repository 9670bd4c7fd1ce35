#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <future>
#include <limits>
#include <memory>
#include <stdexcept>
#include <tuple>

#include "evaluator/counting/log_kicks.hpp"
#include "evaluator/metrics/held_decisions.sql.hpp"
#include "evaluator/metrics/held_shadows.sql.hpp"
#include "evaluator/metrics/predicted_kicks.sql.hpp"
#include "evaluator/page/report_page.hpp"
#include "log/read/clock_offsets.hpp"
#include "log/schema/digest.hpp"

namespace trivela::evaluator::page {
namespace {

namespace fs = std::filesystem;

std::string sha256_of_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  log::RunningSha256 digest;
  std::vector<char> block(1 << 20);
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0) {
    const auto* const bytes = reinterpret_cast<const unsigned char*>(block.data());  // the same bytes
    digest.add({bytes, static_cast<std::size_t>(in.gcount())});
  }
  if (!in.eof()) throw std::runtime_error(fmt::format("cannot read {}: {}", path.string(), std::strerror(errno)));
  return digest.finish();
}

/// Robot, half and the robot's own number of a possession in one play.
using ChanceKey = std::tuple<std::uint32_t, int, int, std::int64_t>;

/// What one recording has of the cycles of a possession.
struct ChanceCycles {
  std::int64_t cycles = 0;
  std::int64_t last_seq = -1;
  double x_m = 0.0, y_m = 0.0;
  std::string policy;
  bool kicked = false;
  std::map<std::pair<std::string, std::string>, std::int64_t> held;                 // by policy and reason
  std::map<std::tuple<std::string, std::string, std::string>, std::int64_t> would;  // and the shadow's policy
  std::optional<double> p_on_target;  // the most that a shadow which would have kicked in play gave its kick
};

bool stands(const std::string& reason) { return reason == "not_playing"; }

/// The held cycles of all logs. Of several recordings of a play the one that has most of a possession counts.
class HeldCycles {
 public:
  explicit HeldCycles(const LoggedOpportunities& logged) {
    for (const ComparedSession& session : logged.sessions) plays_[session.session_id] = session.play;
  }

  void add(const log::Reader& reader) {
    std::map<std::pair<std::int64_t, ChanceKey>, ChanceCycles> fresh;  // by session, too
    reader.query(kHeldDecisionsSql, [&](const log::NamedCells& row) {
      const auto session_id = row.get<std::int64_t>("session_id");
      const auto& policy = row.get<std::string>("policy");
      const auto& reason = row.get<std::string>("reason");
      const auto cycles = row.get<std::int64_t>("cycles");
      const auto seq = row.get<std::int64_t>("seq");
      ChanceCycles& chance = fresh[{session_id,
                                    {plays_[session_id], row.get<int>("robot_id"), row.get<int>("half"),
                                     row.get<std::int64_t>("possession_id")}}];
      if (reason == "fire") {
        chance.kicked = true;
      } else {
        chance.held[{policy, reason}] += cycles;
      }
      chance.cycles += cycles;
      if (stands(reason) || seq <= chance.last_seq) return;
      chance.last_seq = seq;
      chance.policy = policy;
      chance.x_m = row.get<double>("x_m");
      chance.y_m = row.get<double>("y_m");
    });
    reader.query(kHeldShadowsSql, [&](const log::NamedCells& row) {
      const auto session_id = row.get<std::int64_t>("session_id");
      const auto& reason = row.get<std::string>("reason");
      const auto chance = fresh.find({session_id,
                                      {plays_[session_id], row.get<int>("robot_id"), row.get<int>("half"),
                                       row.get<std::int64_t>("possession_id")}});
      if (chance == fresh.end()) return;
      chance->second.would[{row.get<std::string>("policy"), reason, row.get<std::string>("shadow")}] +=
          row.get<std::int64_t>("cycles");
      if (!stands(reason))
        chance->second.p_on_target = std::max(chance->second.p_on_target, row.find<double>("p_on_target"));
    });
    for (auto& [key, chance] : fresh) {
      ChanceCycles& kept = chances_[key.second];
      if (chance.cycles > kept.cycles) kept = std::move(chance);
    }
  }

  void fill(PageData& data) const {
    std::map<std::pair<std::string, std::string>, HeldReason> reasons;
    for (const auto& [key, chance] : chances_) {
      for (const auto& [why, cycles] : chance.held) {
        HeldReason& row = reasons[why];
        row.cycles += cycles;
        ++row.chances;
      }
      bool would = false;
      for (const auto& [what, cycles] : chance.would) {
        const auto& [policy, reason, shadow] = what;
        WouldKick& row = reasons[{policy, reason}].would[shadow];
        row.cycles += cycles;
        ++row.chances;
        would = would || !stands(reason);
      }
      const bool numbered = std::get<3>(key) != 0;
      if (!chance.kicked && numbered && chance.last_seq >= 0)
        data.held_chances.push_back({chance.policy, chance.x_m, chance.y_m, would, chance.p_on_target});
    }
    for (auto& [why, row] : reasons) {
      std::tie(row.policy, row.reason) = why;
      data.held.push_back(row);
    }
    std::ranges::stable_sort(data.held, [](const HeldReason& a, const HeldReason& b) {
      return std::tuple(a.policy, -a.cycles) < std::tuple(b.policy, -b.cycles);
    });
  }

 private:
  std::map<std::int64_t, std::uint32_t> plays_;
  std::map<ChanceKey, ChanceCycles> chances_;
};

/// Reads one part after the other, says which begins, and notes what goes wrong: a stream that is missing costs its
/// section alone.
class Parts {
 public:
  Parts(PageData& data, const PageProgress& progress, std::size_t logs)
      : data_(data), progress_(progress), parts_(5 * logs + 7) {}

  void begin(const char* what) {
    if (progress_) progress_(done_++, parts_, what);
  }

  template <class Read>
  void read(const char* what, Read&& read) {
    begin(what);
    try {
      read();
    } catch (const std::runtime_error& error) {
      data_.failures.push_back(fmt::format("{}: {}", what, error.what()));
    }
  }

 private:
  PageData& data_;
  const PageProgress& progress_;
  std::size_t parts_, done_ = 0;
};

void compare(const LoggedOpportunities& logged, PageData& data) {
  try {
    std::string by;  // arms where there are several, else policies
    KickDataset dataset = kick_dataset_of(logged, {}, by);
    data.comparison = compare_policies(std::move(dataset), by);
  } catch (const std::runtime_error& error) {
    data.no_comparison = error.what();
  }
}

void read_kicks(const log::Reader& reader, std::size_t log, PageData& data) {
  for (KickTimeline& timeline : kicks_without_tracks(reader)) data.kicks.push_back({log, std::move(timeline)});
}

void read_predictions(const log::Reader& reader, PageData& data) {
  reader.query(kPredictedKicksSql, [&](const log::NamedCells& row) {
    data.predictions.push_back({row.get<double>("p_on_target"), row.get<bool>("on_target")});
    const auto p_goal = row.find<double>("p_goal");
    const auto goal = row.find<bool>("goal");
    if (p_goal && goal) data.predicted_goals.push_back({*p_goal, *goal});
  });
}

/// Out of what was counted when a session ended, where it was: a long log is not walked through for four names.
void read_shadows(const log::Reader& reader, PageData& data) {
  reader.query(
      "SELECT policy FROM session_tallies WHERE in_charge = 0 AND session_id IN (SELECT session_id FROM "
      "tallied_sessions) UNION SELECT d.policy FROM sessions AS s CROSS JOIN shadow_decisions AS d ON d.session_id = "
      "s.session_id WHERE s.session_id NOT IN (SELECT session_id FROM tallied_sessions)",
      [&](const std::string& policy) { data.shadows.push_back(policy); });
}

void read_clocks(const log::Reader& reader, PageData& data) {
  std::map<std::pair<int, int>, ClockRow> rows;
  for (const log::ClockOffset& offset : log::clock_offsets(reader)) {
    ClockRow& row = rows[{offset.robot_id, offset.other_robot_id}];
    const double ms = 1e-6 * static_cast<double>(offset.offset_ns);
    const double error_ms = 1e-6 * static_cast<double>(offset.error_ns);
    row.least_ms = row.measurements == 0 ? ms : std::min(row.least_ms, ms);
    row.most_ms = row.measurements == 0 ? ms : std::max(row.most_ms, ms);
    row.error_ms = row.measurements == 0 ? error_ms : std::min(row.error_ms, error_ms);
    ++row.measurements;
  }
  for (auto& [who, row] : rows) {
    std::tie(row.robot_id, row.other_robot_id) = who;
    data.clocks.push_back(row);
  }
  reader.query(
      "SELECT s.uuid, max(c.error_ns) * 1e-6, min(c.reference_uuid) FROM session_clocks AS c JOIN sessions AS s ON "
      "s.session_id = c.session_id GROUP BY s.uuid ORDER BY s.uuid",
      [&](const std::string& uuid, double error_ms, const std::string& reference) {
        data.aligned.push_back({uuid, error_ms, reference});
      });
}

/// What differs between each log and the one that was recorded before it.
void read_changes(const std::vector<fs::path>& logs, const std::vector<OpenLog>& readers, PageData& data) {
  std::vector<std::pair<std::int64_t, std::size_t>> by_time;  // the first instant of each, UTC
  for (std::size_t i = 0; i < readers.size(); ++i) {
    std::int64_t first_ns = std::numeric_limits<std::int64_t>::max();
    readers[i].reader->query(
        "SELECT min(s.started_t_ns + u.utc_offset_ns) FROM sessions AS s JOIN utc_offsets AS u ON u.session_id = "
        "s.session_id",
        [&](std::optional<std::int64_t> started_ns) { first_ns = started_ns.value_or(first_ns); });
    by_time.emplace_back(first_ns, i);
  }
  std::ranges::sort(by_time);  // those of one instant as they were named
  for (std::size_t n = 1; n < by_time.size(); ++n) {
    const std::size_t before = by_time[n - 1].second, after = by_time[n].second;
    data.changes.push_back({before, after, log_differences(std::array{logs[before], logs[after]})});
  }
}

/// The times of the halves, of so many kicks that they are listed.
void read_half_times(const std::vector<OpenLog>& readers, PageData& data) {
  if (data.binned()) return;
  for (PageKick& kick : data.kicks) add_half_time(*readers[kick.log].reader, kick.timeline);
}

/// The paths of robots and balls, of so many kicks that they fit a page.
void read_tracks(const std::vector<OpenLog>& readers, PageData& data) {
  if (data.kicks.size() > kMostReplays) return;
  for (PageKick& kick : data.kicks) add_tracks(*readers[kick.log].reader, kick.timeline);
}

/// Shadows by name, each once; kicks by time.
void sort_all(PageData& data) {
  std::ranges::sort(data.shadows);
  data.shadows.erase(std::unique(data.shadows.begin(), data.shadows.end()), data.shadows.end());
  std::ranges::stable_sort(data.kicks, {}, [](const PageKick& kick) {
    return std::tuple(kick.timeline.utc_ns, kick.timeline.session_id, kick.timeline.robot_id, kick.timeline.kick_id);
  });
}

}  // namespace

PageData read_page_data(const std::vector<fs::path>& logs, const PageProgress& progress) {
  PageData data;
  Parts parts{data, progress, logs.size()};
  std::vector<std::unique_ptr<log::Reader>> open;
  std::vector<OpenLog> readers;
  // A file is hashed while its rows are read: in a long log each takes about as long as the other.
  auto hashes = std::async(std::launch::async, [&logs] {
    std::vector<std::string> sha256;
    sha256.reserve(logs.size());
    for (const fs::path& path : logs) sha256.push_back(sha256_of_file(path));
    return sha256;
  });
  for (const fs::path& path : logs) {
    open.push_back(std::make_unique<log::Reader>(path, log::Check::kSchema));  // the report has looked closer
    readers.push_back({open.back().get(), path.filename().string()});
    data.logs.push_back({readers.back().name, {}});
  }
  LoggedOpportunities logged;
  parts.read("chances", [&] {
    logged = read_opportunities(readers, false);
    for (const LoggedOpportunity& o : logged.rows) {
      if (o.has_possession && !o.policy.empty()) ++data.opportunities[o.policy];
    }
  });
  compare(logged, data);
  HeldCycles held(logged);
  for (std::size_t i = 0; i < readers.size(); ++i) {
    const log::Reader& reader = *readers[i].reader;
    parts.read("kicks", [&] { read_kicks(reader, i, data); });
    parts.read("decisions", [&] { held.add(reader); });
    parts.read("predicted chances", [&] { read_predictions(reader, data); });
    parts.read("clocks", [&] { read_clocks(reader, data); });
    parts.read("shadows", [&] { read_shadows(reader, data); });
  }
  held.fill(data);
  sort_all(data);
  parts.read("drift of kickers", [&] { data.drift = drift_in(readers); });
  parts.read("differences between the logs", [&] { read_changes(logs, readers, data); });
  parts.read("replays", [&] { data.again = decided_again(readers); });
  parts.read("times of the halves", [&] { read_half_times(readers, data); });
  parts.read("tracks of robots and balls", [&] { read_tracks(readers, data); });
  parts.begin("files");
  for (std::size_t i = 0; auto& sha256 : hashes.get()) data.logs[i++].sha256 = std::move(sha256);
  return data;
}

}  // namespace trivela::evaluator::page
