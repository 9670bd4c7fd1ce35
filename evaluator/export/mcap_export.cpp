#include "evaluator/export/export_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "evaluator/mcap/mcap_writer.hpp"
#include "evaluator/mcap/messages.hpp"
#include "evaluator/sessions/session_facts.hpp"
#include "evaluator/timeline/decided_segments.hpp"
#include "kicking/constants.hpp"
#include "log/schema/queries.hpp"

namespace trivela::evaluator {
namespace {

using log::Value;
using mcap::Colour;
using mcap::Header;
using mcap::Marker;

constexpr std::string_view kMarkers = "visualization_msgs/MarkerArray";
constexpr Colour kWhite{1, 1, 1, 1}, kOrange{1, 0.5F, 0, 1}, kBlue{0.2F, 0.5F, 1, 1}, kGreen{0.2F, 0.8F, 0.3F, 1},
    kGrey{0.6F, 0.6F, 0.6F, 0.8F};

Header in_field(std::int64_t t_ns) { return {t_ns, "field"}; }

Marker ball_at(const std::string& what, const Colour& colour, const std::optional<Eigen::Vector3d>& place) {
  Marker marker{what, Marker::kSphere, place.has_value(), colour, 2.0 * kicking::Ball{}.radius_m, {}};
  if (place) marker.places = {*place};
  return marker;
}

/// A crossing of the goal line; none where it is not known.
Marker crossing(const std::string& what, const Colour& colour, std::optional<double> x_m, double y_m,
                std::optional<double> z_m) {
  std::optional<Eigen::Vector3d> place;
  if (x_m && z_m) place.emplace(*x_m, y_m, *z_m);
  return ball_at(what, colour, place);
}

std::vector<Marker> segments(const log::NamedCells& cells) {
  const DecidedSegments s =
      decided_segments({{cells.get<double>("x_m"), cells.get<double>("y_m"), cells.get<double>("heading_rad")},
                        cells.get<double>("alpha_rad"),
                        {cells.get<double>("target_x_m"), cells.get<double>("target_y_m")},
                        cells.get<double>("distance_m"),
                        cells.get<bool>("aligned"),
                        cells.find<double>("offset_right_m"),
                        cells.get<double>("left_m"),
                        cells.get<double>("right_m")});
  const auto up = [](const Eigen::Vector2d& p) { return Eigen::Vector3d(p.x(), p.y(), 0.02); };
  const Colour& s1 = s.aligned ? kGreen : kOrange;
  return {Marker{"s1", Marker::kLineList, true, s1, 0.03, {up(s.s1_from_m), up(s.s1_to_m)}},
          Marker{"s2", Marker::kLineList, true, kBlue, 0.03, {up(s.s2_left_m), up(s.s2_right_m)}}};
}

/// Puts a message that lies in a Cdr on a topic: its name, its standard type.
using PutMessage = std::function<void(const std::string& topic, std::string_view type)>;

/// The scene that export_mcap() writes beside the rows.
class MatchScene {
 public:
  explicit MatchScene(mcap::Cdr& cdr) : cdr_(cdr) {}

  /// Lines of the field and the goal, on `topic`.
  void put_field(const LoggedPitch& pitch, std::int64_t t_ns, const std::string& topic, const PutMessage& put) {
    const double side = pitch.side_line_x_m, line = pitch.goal.y_m;
    const double post = pitch.goal.half_width_m + 0.5 * pitch.goal.post_width_m;
    const double bar = pitch.goal.height_m + 0.5 * pitch.goal.post_width_m;
    Marker lines{"lines", Marker::kLineList, true, kWhite, 0.125, {}};
    for (const double y : {-line, 0.0, line})
      lines.places.insert(lines.places.end(), {{-side, y, 0.0}, {side, y, 0.0}});
    for (const double x : {-side, side}) lines.places.insert(lines.places.end(), {{x, -line, 0.0}, {x, line, 0.0}});
    Marker goals{"goals", Marker::kLineList, true, kWhite, pitch.goal.post_width_m, {}};
    for (const double y : {-line, line}) {
      goals.places.insert(goals.places.end(), {{-post, y, 0.0}, {-post, y, bar}, {post, y, 0.0}, {post, y, bar}});
      goals.places.insert(goals.places.end(), {{-post, y, bar}, {post, y, bar}});
    }
    write_markers(cdr_, in_field(t_ns), {lines, goals});
    put(topic, kMarkers);
  }

  /// What a row shows, on topics that begin with `prefix`; most tables show nothing.
  void put_row(const log::StreamTable& table, const log::NamedCells& cells, std::int64_t t_ns, double goal_y_m,
               const std::string& prefix, const std::string& robot, const PutMessage& put) {
    const Header header = in_field(t_ns);
    const auto crossings = [&](const Marker& marker) {
      write_markers(cdr_, header, {marker});
      put(prefix + "/crossings", kMarkers);
    };
    if (table.name == "world_states") {
      const mcap::FloorPose pose{cells.get<double>("x_m"), cells.get<double>("y_m"),
                                 cells.get<double>("heading_rad") + 0.5 * std::numbers::pi};
      write_transform(cdr_, header, robot, pose);
      put("/tf", "tf2_msgs/TFMessage");
      write_pose(cdr_, header, pose);
      put(prefix + "/pose", "geometry_msgs/PoseStamped");
      const auto x_m = cells.find<double>("ball_x_m"), y_m = cells.find<double>("ball_y_m");
      std::optional<Eigen::Vector3d> ball;
      if (cells.get<bool>("ball_known") && x_m && y_m) ball.emplace(*x_m, *y_m, kicking::Ball{}.radius_m);
      write_markers(cdr_, header, {ball_at("ball", kOrange, ball)});
      put(prefix + "/ball", kMarkers);
    } else if (table.name == "kick_decisions") {
      write_markers(cdr_, header, segments(cells));
      put(prefix + "/alignment", kMarkers);
      if (cells.get<bool>("fire"))
        crossings(crossing("predicted", kBlue, cells.find<double>("predicted_x_cross_m"),
                           cells.get<double>("target_y_m"), cells.find<double>("predicted_z_cross_m")));
    } else if (table.name == "kick_outcomes") {
      crossings(
          crossing("observed", kGreen, cells.find<double>("x_cross_m"), goal_y_m, cells.find<double>("z_cross_m")));
    } else if (table.name == "kick_truths") {
      crossings(crossing("simulated truth", kGrey, cells.find<double>("x_cross_m"), goal_y_m,
                         cells.find<double>("z_cross_m")));
    }
  }

 private:
  mcap::Cdr& cdr_;
};

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
  std::optional<std::size_t> instant;  ///< column of its time
  std::string prefix, robot, topic;
  std::optional<std::uint16_t> channel{};  ///< from its first row on
};

class McapExport {
 public:
  McapExport(const log::Reader& reader, const ExportPlan& plan, const std::filesystem::path& file,
             const std::string& library, const ExportProgress& progress)
      : reader_(reader), tables_(tables_of(plan)), pace_(progress), scene_(cdr_), writer_(file, library) {
    read_sessions(plan);
    for (const ExportedSession& session : sessions_) {
      for (const log::StreamTable& table : tables_) add_parts(session, table);
    }
    name_sessions();
  }

  ExportedRows write() {
    for (const ExportedSession& of : sessions_) describe(of);
    reader_.for_each_row_in_time(
        asked_, [this](std::size_t i, std::span<const Value> row) { return instant_of(parts_[i], row); },
        [this](std::size_t i, std::int64_t t_ns, std::span<const Value> row) {
          put_row(parts_[i], asked_[i].columns, t_ns, row);
        });
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
    ExportedPart part{&table, &of, {}, "", "", ""};
    std::vector<std::string> columns;
    for (const log::StreamColumn& column : table.columns) columns.push_back(column.name);
    for (const char* const column : {"t_ns", "from_t_ns"}) {
      if (!part.instant && table.has(column))
        part.instant = static_cast<std::size_t>(std::ranges::find(columns, column) - columns.begin());
    }
    const auto add = [&](std::optional<int> robot_id) {
      parts_.push_back(part);
      asked_.push_back({table.name, columns, table.key, of.session.session_id, robot_id});
    };
    if (!table.is_of_robots()) return add(std::nullopt);
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

  void put_row(ExportedPart& part, const std::vector<std::string>& columns, std::int64_t t_ns,
               std::span<const Value> row) {
    log::NamedCells cells{columns};
    cells.set(row);
    pace_.row();
    ++rows_[part.table->name];
    write_row(cdr_, *part.table, row);
    if (!part.channel) part.channel = channel_of(part.topic, mcap::schema_of(*part.table));
    const auto number = part.table->is_of_robots() ? cells.get<std::int64_t>("seq") : std::int64_t{0};
    writer_.write(*part.channel, static_cast<std::uint32_t>(number), static_cast<std::uint64_t>(t_ns), cdr_.bytes());
    if (part.robot.empty()) return;
    scene_.put_row(*part.table, cells, t_ns, part.of->pitch.goal.y_m, part.prefix, part.robot,
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
