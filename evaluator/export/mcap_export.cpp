#include "evaluator/export/export_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "evaluator/export/match_scene.hpp"
#include "evaluator/mcap/mcap_writer.hpp"
#include "evaluator/mcap/messages.hpp"
#include "log/schema/queries.hpp"

namespace trivela::evaluator {
namespace {

using log::Value;

/// UTC of a session's clock, from one instant on.
struct ClockPiece {
  std::int64_t from_t_ns, utc_offset_ns;
  double rate;
};

/// A session with what its rows need.
struct ExportedSession {
  log::RecordedSession session;
  LoggedPitch pitch{};
  std::vector<ClockPiece> clock;  ///< none: by its own offset
  std::set<int> robots;
  std::string prefix;  ///< of its topics

  std::int64_t utc_ns(std::int64_t t_ns) const {
    if (clock.empty()) return sum(t_ns, session.realtime_offset_ns);
    auto piece = std::ranges::upper_bound(clock, t_ns, {}, &ClockPiece::from_t_ns);
    if (piece != clock.begin()) --piece;
    const double since_ns = static_cast<double>(t_ns - piece->from_t_ns);
    return sum(sum(t_ns, piece->utc_offset_ns), std::llround(piece->rate * since_ns));
  }

 private:
  /// A log may say anything: no instant is out of range.
  static std::int64_t sum(std::int64_t a, std::int64_t b) {
    std::int64_t result = 0;
    return __builtin_add_overflow(a, b, &result)
               ? (a < 0 ? std::numeric_limits<std::int64_t>::min() : std::numeric_limits<std::int64_t>::max())
               : result;
  }
};

/// A part of a table as its messages need it.
struct ExportedPart {
  const log::StreamTable* table;
  const ExportedSession* of;
  const Places* places;
  std::optional<std::size_t> instant, number;  ///< columns of its time and of seq
  std::string prefix, robot, topic;
  std::optional<std::uint16_t> channel{};  ///< from its first row on
};

class McapExport {
 public:
  McapExport(const log::Reader& reader, const ExportPlan& plan, const std::filesystem::path& file,
             const std::string& library, const ExportProgress& progress)
      : reader_(reader), tables_(tables_of(plan)), pace_(progress), scene_(cdr_), writer_(file, library) {
    read_sessions(plan);
    for (const log::StreamTable& table : tables_) places_.try_emplace(table.name, table);
    for (const ExportedSession& session : sessions_) {
      for (const log::StreamTable& table : tables_) add_parts(session, table);
    }
    name_sessions();
  }

  ExportedRows write() {
    for (const ExportedSession& of : sessions_) describe(of);
    reader_.for_each_row_in_time(
        asked_, [this](std::size_t i, std::span<const Value> row) { return instant_of(parts_[i], row); },
        [this](std::size_t i, std::int64_t t_ns, std::span<const Value> row) { put_row(parts_[i], t_ns, row); });
    writer_.close();
    return std::move(rows_);
  }

 private:
  void read_sessions(const ExportPlan& plan) {
    const auto chosen = sessions_of(plan, reader_);
    if (chosen.size() > kMostSessionsOfMcap)
      throw BadExport(
          fmt::format("{} sessions are too many for one MCAP file, which has {} at most: choose by --session",
                      chosen.size(), kMostSessionsOfMcap));
    for (const log::RecordedSession& session : chosen) {
      ExportedSession& of = sessions_.emplace_back();
      of.session = reader_.whole(session);
      of.pitch = pitch_of(of.session.config_toml);
      reader_.query(fmt::format("SELECT from_t_ns, utc_offset_ns, rate FROM session_clocks WHERE session_id = {} "
                                "ORDER BY from_t_ns",
                                session.session_id),
                    [&](std::int64_t from_t_ns, std::int64_t utc_offset_ns, double rate) {
                      of.clock.push_back({from_t_ns, utc_offset_ns, rate});
                    });
      for (const log::StreamTable& table : log::stream_tables()) {
        if (!table.is_of_robots()) continue;
        for (const int robot : reader_.robots_in(table.name, session.session_id)) of.robots.insert(robot);
      }
    }
  }

  void add_parts(const ExportedSession& of, const log::StreamTable& table) {
    ExportedPart part{&table, &of, &places_.at(table.name), {}, {}, "", "", ""};
    for (const char* const column : {"t_ns", "from_t_ns"}) {
      if (!part.instant && table.has(column)) part.instant = (*part.places)[column];
    }
    std::vector<std::string> columns;
    for (const log::StreamColumn& column : table.columns) columns.push_back(column.name);
    const auto add = [&](std::optional<int> robot_id) {
      parts_.push_back(part);
      asked_.push_back({table.name, columns, table.key, of.session.session_id, robot_id});
    };
    if (!table.is_of_robots()) return add(std::nullopt);
    part.number = (*part.places)["seq"];
    for (const int robot_id : reader_.robots_in(table.name, of.session.session_id)) {
      part.robot = fmt::format("robot_{}", robot_id);
      add(robot_id);
    }
  }

  /// Two recordings of a robot at one time would be mixed on one topic.
  void name_sessions() {
    const auto end_of = [](const ExportedSession& s) {
      return s.session.closed_t_ns ? s.utc_ns(*s.session.closed_t_ns) : std::numeric_limits<std::int64_t>::max();
    };
    const auto meet = [&](const ExportedSession& a, const ExportedSession& b) {
      return a.utc_ns(a.session.started_t_ns) < end_of(b) && b.utc_ns(b.session.started_t_ns) < end_of(a) &&
             std::ranges::any_of(a.robots, [&](int robot) { return b.robots.contains(robot); });
    };
    bool mixed = false;
    for (std::size_t i = 0; i < sessions_.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) mixed = mixed || meet(sessions_[i], sessions_[j]);
    if (mixed)
      for (ExportedSession& s : sessions_) s.prefix = "/session_" + s.session.uuid;
    for (ExportedPart& part : parts_) {
      part.prefix = part.of->prefix + (part.robot.empty() ? "/log" : "/" + part.robot);
      part.topic = part.prefix + "/" + part.table->name;
      if (mixed && !part.robot.empty()) part.robot = part.prefix.substr(1);  // a frame of its own
    }
  }

  void describe(const ExportedSession& of) {
    const log::RecordedSession& s = of.session;
    writer_.add_metadata("session " + s.uuid, {{"uuid", s.uuid},
                                               {"simulated", s.simulated ? "yes" : "no"},
                                               {"scenario", s.scenario},
                                               {"software_version", s.software_version},
                                               {"realtime_offset_ns", fmt::to_string(s.realtime_offset_ns)},
                                               {"configuration", s.config_toml}});
    const auto t_ns = std::max(std::int64_t{0}, of.utc_ns(s.started_t_ns));
    scene_.put_field(of.pitch, t_ns, of.prefix + "/field",
                     [&](const std::string& topic, std::string_view type) { put_standard(topic, type, t_ns); });
  }

  std::int64_t instant_of(const ExportedPart& part, std::span<const Value> row) const {
    const std::int64_t* t_ns = part.instant ? std::get_if<std::int64_t>(&row[*part.instant]) : nullptr;
    return std::max(std::int64_t{0}, part.of->utc_ns(t_ns != nullptr ? *t_ns : part.of->session.started_t_ns));
  }

  void put_row(ExportedPart& part, std::int64_t t_ns, std::span<const Value> row) {
    pace_.row();
    ++rows_[part.table->name];
    write_row(cdr_, *part.table, row);
    if (!part.channel) part.channel = channel_of(part.topic, mcap::schema_of(*part.table));
    const auto number = part.number ? log::cell_as<std::int64_t>(row[*part.number], *part.number) : std::int64_t{0};
    writer_.write(*part.channel, static_cast<std::uint32_t>(number), static_cast<std::uint64_t>(t_ns), cdr_.bytes());
    if (part.robot.empty()) return;
    scene_.put_row(*part.table, *part.places, row, t_ns, part.of->pitch.goal.y_m, part.prefix, part.robot,
                   [&](const std::string& topic, std::string_view type) { put_standard(topic, type, t_ns); });
  }

  void put_standard(const std::string& topic, std::string_view type, std::int64_t t_ns) {
    auto channel = channels_.find(topic);
    if (channel == channels_.end()) {
      channel_of(topic, mcap::standard_schema(type));
      channel = channels_.find(topic);
    }
    writer_.write(channel->second, 0, static_cast<std::uint64_t>(t_ns), cdr_.bytes());
  }

  /// One a topic: a robot's rows in several sessions go on in the same.
  std::uint16_t channel_of(const std::string& topic, const mcap::Schema& schema) {
    auto channel = channels_.find(topic);
    if (channel == channels_.end()) channel = channels_.emplace(topic, writer_.add_channel(topic, schema)).first;
    return channel->second;
  }

  const log::Reader& reader_;
  std::vector<log::StreamTable> tables_;
  ExportPace pace_;
  mcap::Cdr cdr_;  // the message under way
  MatchScene scene_;
  mcap::Writer writer_;
  std::vector<ExportedSession> sessions_;
  std::map<std::string, Places> places_;
  std::vector<ExportedPart> parts_;
  std::vector<log::TimedPart> asked_;  // the same parts
  std::map<std::string, std::uint16_t> channels_;
  ExportedRows rows_;
};

}  // namespace

ExportedRows export_mcap(const log::Reader& reader, const ExportPlan& plan, const std::filesystem::path& file,
                         const std::string& library, const ExportProgress& progress) {
  Draft draft(file);
  const Snapshot snapshot(reader);
  ExportedRows rows = McapExport(reader, plan, draft.path(), library, progress).write();
  draft.keep();
  return rows;
}

}  // namespace trivela::evaluator
