#include "cli/import/row_writing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <optional>

#include "cli/import/refbox.hpp"
#include "config/text/installation.hpp"
#include "evaluator/imports/play_statistics.hpp"
#include "idl/messages.hpp"
#include "log/schema/digest.hpp"
#include "robot/recording/session_text.hpp"
#include "robot/referee/match_state.hpp"

namespace trivela::cli {

log::Session imported_session(const std::string& name, const std::vector<std::string>& sentences,
                              const std::string& source, std::int64_t realtime_offset_ns) {
  log::Session session;
  session.config_toml = fmt::format("{}{}\n\n{}", log::kImportMark, fmt::join(sentences, "\n"), source);
  const std::string sha256 = log::sha256(session.config_toml);
  session.uuid = fmt::format("{}-{}-8{}-8{}-{}", sha256.substr(0, 8), sha256.substr(8, 4), sha256.substr(12, 3),
                             sha256.substr(15, 3), sha256.substr(18, 12));
  session.realtime_offset_ns = realtime_offset_ns;
  session.software_version = config::software_version();
  session.scenario = name;
  session.idl = robot::idl_text();
  return session;
}

namespace {

namespace imports = evaluator::imports;

constexpr std::int64_t kLongestStep_ms = 500;  // between poses that a velocity follows from

/// The match command by command, as the live client has it. The log may begin in any part.
class GameState {
 public:
  GameState(const imports::RefereeLog& log, imports::BoxSide ours) : ours_(ours) {
    using enum refbox::CommandKind;
    constexpr std::array kBegins{kFirstHalf, kSecondHalf, kFirstHalfOvertime, kSecondHalfOvertime};
    const bool before = log.lines.front().state.starts_with("Pre");
    if (!before) match_.command({kBegins.at(static_cast<std::size_t>(imports::first_part(log) - 1)), {}}, 0);
  }

  void receive(const imports::RefereeLine& line, std::int64_t t_ns) {
    if (refbox::begun_part(line.command)) match_.command({imports::BoxCommand::kStop, {}}, t_ns);
    match_.command({line.command, side_of(line.side)}, t_ns);
  }
  msg::Referee message(std::int64_t t_ns) const { return match_.message(t_ns); }

 private:
  hal::refbox::Side side_of(imports::BoxSide side) const {
    if (side == imports::BoxSide::kBoth) return hal::refbox::Side::kBoth;
    return side == ours_ ? hal::refbox::Side::kOurs : hal::refbox::Side::kTheirs;
  }

  imports::BoxSide ours_;
  robot::MatchState match_;
};

std::int64_t nanoseconds_since(std::int64_t start_ms, std::int64_t t_ms) { return (t_ms - start_ms) * 1'000'000; }

void write_referee(RowWriting& rows, const imports::RefereeLog& log, imports::BoxSide ours, std::int64_t start_ms) {
  GameState game(log, ours);
  std::uint64_t seq = 0;
  for (const imports::RefereeLine& line : log.lines) {
    const std::int64_t t_ns = nanoseconds_since(start_ms, line.t_ms);
    game.receive(line, t_ns);
    msg::Referee row = game.message(t_ns);
    row.seq = row.command_counter = ++seq;
    rows.write(row);
  }
}

/// The game as it was at instants that never fall.
class GameAt {
 public:
  explicit GameAt(const imports::RefereeLog& log) : log_(log), game_(log, imports::BoxSide::kBoth) {}
  msg::Referee at(std::int64_t t_ms) {
    for (; next_ < log_.lines.size() && log_.lines[next_].t_ms <= t_ms; ++next_) game_.receive(log_.lines[next_], 0);
    return game_.message(0);
  }

 private:
  const imports::RefereeLog& log_;
  GameState game_;
  std::size_t next_ = 0;
};

/// Velocities in F [m/s, m/s, rad/s], from the latest pose where none is told.
class Velocities {
 public:
  std::optional<std::array<double, 3>> of(const imports::ReportedRobot& robot, std::int64_t t_ms) {
    const auto [place, first] = latest_.try_emplace(robot.id, Latest{robot, t_ms});
    const Latest before = std::exchange(place->second, Latest{robot, t_ms});
    if (robot.velocity) return robot.velocity;
    const std::int64_t step_ms = t_ms - before.t_ms;
    if (first || step_ms <= 0 || step_ms > kLongestStep_ms) return std::nullopt;
    const double step_s = 1e-3 * static_cast<double>(step_ms);
    const double turned_rad = std::remainder(robot.heading_rad - before.robot.heading_rad, 2.0 * M_PI);
    return std::array{(robot.x_m - before.robot.x_m) / step_s, (robot.y_m - before.robot.y_m) / step_s,
                      turned_rad / step_s};
  }

 private:
  struct Latest {
    imports::ReportedRobot robot;
    std::int64_t t_ms = 0;
  };
  std::map<int, Latest> latest_;  // by robot
};

/// The robot's twist is told in F and stands in R: turned by minus its heading.
msg::WorldState world_state(const imports::ReportedRobot& robot, const std::array<double, 3>& velocity,
                            const std::optional<imports::ReportedBall>& ball) {
  const double c = std::cos(robot.heading_rad), s = std::sin(robot.heading_rad);
  msg::WorldState row{};
  row.robot_id = static_cast<std::uint8_t>(robot.id);
  row.x_m = robot.x_m;
  row.y_m = robot.y_m;
  row.heading_rad = robot.heading_rad;
  row.vx_mps = c * velocity[0] + s * velocity[1];
  row.vy_mps = c * velocity[1] - s * velocity[0];
  row.omega_radps = velocity[2];
  row.possession = robot.ball_engaged;
  row.ball_known = ball.has_value();
  row.ball_x_m = ball ? ball->x_m : msg::kNone;
  row.ball_y_m = ball ? ball->y_m : msg::kNone;
  row.ball_vx_mps = ball && ball->velocity ? (*ball->velocity)[0] : msg::kNone;
  row.ball_vy_mps = ball && ball->velocity ? (*ball->velocity)[1] : msg::kNone;
  row.ball_age_s = row.opponent_distance_m = msg::kNone;
  return row;
}

void write_team(RowWriting& rows, const imports::TeamLog& team, const std::vector<std::int64_t>& times_ms,
                const imports::RefereeLog& referee, std::int64_t start_ms, ImportedRows& imported) {
  GameAt game(referee);
  Velocities velocities;
  std::map<int, std::uint64_t> seqs;
  for (std::size_t i = 0; i < team.usable.size(); ++i) {
    const msg::Referee now = game.at(times_ms[i]);
    for (const imports::ReportedRobot& robot : team.usable[i].robots) {
      const auto velocity = velocities.of(robot, times_ms[i]);
      imported.without_velocity += velocity ? 0 : 1;
      if (!velocity) continue;
      msg::WorldState row = world_state(robot, *velocity, team.usable[i].ball);
      row.seq = ++seqs[robot.id];
      row.t_ns = nanoseconds_since(start_ms, times_ms[i]);
      row.half = now.half;
      row.playing = now.playing;
      rows.write(row);
      ++imported.world_states;
    }
  }
}

// Records an hour from any command are of another match: a box is started for a match and ended with it.
void check_same_match(const imports::RefereeLog& referee, const std::string& team_file,
                      const std::vector<std::int64_t>& times_ms) {
  constexpr std::int64_t kLongestApart_ms = 3'600'000;
  if (times_ms.empty()) return;
  const std::int64_t after_ms = times_ms.front() - referee.lines.back().t_ms;
  const std::int64_t before_ms = referee.lines.front().t_ms - times_ms.back();
  const std::int64_t apart_ms = std::max(after_ms, before_ms);
  if (apart_ms <= kLongestApart_ms) return;
  throw std::runtime_error(fmt::format("{} and {} are not of the same match: they are {:.1f} h apart", team_file,
                                       referee.file, static_cast<double>(apart_ms) / 3.6e6));
}

}  // namespace

ImportedRows write_match_log(const imports::RefereeLog& referee, imports::BoxSide ours,
                             const imports::SidedTeamLog* team, const std::vector<std::string>& sentences,
                             const std::filesystem::path& out) {
  if (referee.lines.empty()) throw std::runtime_error(referee.file + ": no command in it, so there is no match to log");
  const auto times_ms = team != nullptr ? imports::record_times_ms(team->log, &referee) : std::vector<std::int64_t>();
  if (team != nullptr) check_same_match(referee, team->log.file, times_ms);
  std::int64_t start_ms = referee.lines.front().t_ms;
  if (!times_ms.empty()) start_ms = std::min(start_ms, times_ms.front());
  ImportedRows imported{.referee = std::ssize(referee.lines)};
  RowWriting rows(out, imported_session(referee.file, sentences, "", start_ms * 1'000'000));
  write_referee(rows, referee, ours, start_ms);
  if (team != nullptr) write_team(rows, team->log, times_ms, referee, start_ms, imported);
  rows.finish();
  return imported;
}

}  // namespace trivela::cli
