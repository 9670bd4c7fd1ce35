#include "cli/import/refbox.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>

#include "evaluator/render/text_table.hpp"
#include "kicking/text/printable.hpp"

namespace trivela::cli {
namespace {

namespace imports = evaluator::imports;

std::string utc(std::int64_t t_ms) {
  const std::chrono::sys_time<std::chrono::milliseconds> t{std::chrono::milliseconds{t_ms}};
  return fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::gmtime(std::chrono::floor<std::chrono::seconds>(t)));
}

std::string cell_of(const std::optional<double>& value, int digits) {
  return value ? fmt::format("{:.{}f}", *value, digits) : "-";
}

nlohmann::json json_cell(const std::optional<double>& value) { return value ? nlohmann::json(*value) : nullptr; }

std::vector<double> play_lengths_s(const imports::PlayStatistics& statistics) {
  std::vector<double> lengths_s;
  for (const imports::Play& play : statistics.plays)
    lengths_s.push_back(1e-3 * static_cast<double>(play.to_ms - play.from_ms));
  return lengths_s;
}

std::vector<double> durations_s(const TeamSummary& team) {
  std::vector<double> all_s;
  for (const imports::Possession& possession : team.possessions) all_s.push_back(possession.duration_s());
  return all_s;
}

std::vector<double> speeds_mps(const TeamSummary& team) {
  std::vector<double> all_mps;
  for (const imports::Possession& possession : team.possessions)
    all_mps.insert(all_mps.end(), possession.speeds_mps.begin(), possession.speeds_mps.end());
  return all_mps;
}

std::string text_of_game(const RefereeSummary& summary) {
  const imports::RefereeLog& log = *summary.log;
  const imports::PlayStatistics& s = summary.statistics;
  std::string text = fmt::format("{}: {} commands", kicking::printable(log.file), log.lines.size());
  if (!log.lines.empty())
    text += fmt::format(", {} to {} UTC", utc(log.lines.front().t_ms), utc(log.lines.back().t_ms));
  text += fmt::format("; teams connected {} times, were dropped {} times, {} refused\n", log.accepted, log.dropped,
                      log.refused);
  text += evaluator::text_table(
      {{"plays", "mean s", "median s", "minutes played", "stops a minute", "STOP to START s", "set piece to START s"},
       {std::to_string(s.plays.size()), cell_of(imports::mean(play_lengths_s(s)), 1),
        cell_of(imports::median(play_lengths_s(s)), 1), fmt::format("{:.2f}", s.played_s() / 60.0),
        cell_of(s.stops_per_min(), 1), cell_of(imports::median(s.stop_to_start_s), 1),
        cell_of(imports::median(s.restart_to_start_s), 1)}});
  text += "  STOP to START, set piece to START: medians; stops are those that ended a play, a minute of play\n";
  if (s.open_plays > 0) text += "  a play was going on when the log ends; it does not count\n";
  return text;
}

std::string text_of_team(const TeamSummary& summary) {
  const imports::TeamLog& log = summary.team->log;
  std::string text =
      fmt::format("{}: {}, {}, {} records, {} of them usable, {} a second\n", kicking::printable(log.file),
                  log.team.empty() ? "a team without a name" : kicking::printable(log.team),
                  side_name(summary.team->side), log.records, log.usable.size(), cell_of(record_rate_hz(log), 1));
  if (summary.possessions.empty()) return text + "  no possession\n";
  const auto long_s = durations_s(summary);
  const auto fast_mps = speeds_mps(summary);
  text += evaluator::text_table(
      {{"possessions", "median s", "95 % s", "longest s", "median m/s", "95 % m/s", "fastest m/s"},
       {std::to_string(summary.possessions.size()), cell_of(imports::median(long_s), 1),
        cell_of(imports::quantile(long_s, 0.95), 1), cell_of(imports::quantile(long_s, 1.0), 1),
        cell_of(imports::median(fast_mps), 1), cell_of(imports::quantile(fast_mps, 0.95), 1),
        cell_of(imports::quantile(fast_mps, 1.0), 1)}});
  return text;
}

nlohmann::json json_of_game(const RefereeSummary& summary) {
  const imports::RefereeLog& log = *summary.log;
  const imports::PlayStatistics& s = summary.statistics;
  nlohmann::json plays = nlohmann::json::array();
  for (const imports::Play& play : s.plays)
    plays.push_back({{"from_ms", play.from_ms}, {"to_ms", play.to_ms}, {"part", play.part}, {"stopped", play.stopped}});
  return {{"file", log.file},
          {"commands", log.lines.size()},
          {"from_ms", log.lines.empty() ? nlohmann::json() : nlohmann::json(log.lines.front().t_ms)},
          {"to_ms", log.lines.empty() ? nlohmann::json() : nlohmann::json(log.lines.back().t_ms)},
          {"connected", log.accepted},
          {"dropped", log.dropped},
          {"refused", log.refused},
          {"plays", plays},
          {"open_plays", s.open_plays},
          {"play_mean_s", json_cell(imports::mean(play_lengths_s(s)))},
          {"play_median_s", json_cell(imports::median(play_lengths_s(s)))},
          {"played_s", s.played_s()},
          {"stops_per_min", json_cell(s.stops_per_min())},
          {"stop_to_start_median_s", json_cell(imports::median(s.stop_to_start_s))},
          {"restart_to_start_median_s", json_cell(imports::median(s.restart_to_start_s))}};
}

nlohmann::json json_of_team(const TeamSummary& summary) {
  const imports::TeamLog& log = summary.team->log;
  const auto speeds = speeds_mps(summary);
  nlohmann::json possessions = nlohmann::json::array();
  for (const imports::Possession& possession : summary.possessions) {
    possessions.push_back({{"robot_id", possession.robot_id},
                           {"from_ms", possession.from_ms},
                           {"to_ms", possession.to_ms},
                           {"median_mps", json_cell(imports::median(possession.speeds_mps))}});
  }
  return {{"file", log.file},
          {"team", log.team},
          {"side", side_name(summary.team->side)},
          {"records", log.records},
          {"usable", log.usable.size()},
          {"records_per_s", json_cell(record_rate_hz(log))},
          {"possessions", possessions},
          {"possession_median_s", json_cell(imports::median(durations_s(summary)))},
          {"possession_95_s", json_cell(imports::quantile(durations_s(summary), 0.95))},
          {"speed_median_mps", json_cell(imports::median(speeds))},
          {"speed_95_mps", json_cell(imports::quantile(speeds, 0.95))},
          {"speed_max_mps", json_cell(imports::quantile(speeds, 1.0))}};
}

nlohmann::json json_of_faults(const std::string& file, const imports::FaultCounter& faults) {
  nlohmann::json all = nlohmann::json::array();
  for (const imports::Fault& fault : faults.all()) {
    all.push_back({{"file", file},
                   {"fault", fault.name},
                   {"count", fault.count},
                   {"first", fault.first > 0 ? nlohmann::json(fault.first) : nlohmann::json()},
                   {"key", fault.key},
                   {"value", fault.value}});
  }
  return all;
}

}  // namespace

const char* side_name(imports::BoxSide side) { return side == imports::BoxSide::kMagenta ? "magenta" : "cyan"; }

RefboxSummary summary_of(const imports::BoxLogs& logs) {
  RefboxSummary summary{.referee = {}, .teams = {}, .faults = logs.faults()};
  for (const imports::RefereeLog& log : logs.referee) summary.referee.push_back({&log, play_statistics(log)});
  const imports::RefereeLog* const only = logs.referee.size() == 1 ? &logs.referee.front() : nullptr;
  for (const imports::SidedTeamLog& team : logs.teams)
    summary.teams.push_back({&team, possessions(team.log, record_times_ms(team.log, only))});
  return summary;
}

std::string to_text(const RefboxSummary& summary) {
  std::string text;
  for (const RefereeSummary& game : summary.referee) text += text_of_game(game);
  for (const TeamSummary& team : summary.teams) text += text_of_team(team);
  text += summary.faults.empty() ? "Nothing is wrong with the files\n" : "What is wrong with the files\n";
  for (const std::string& fault : summary.faults) text += fmt::format("  {}\n", kicking::printable(fault));
  return text;
}

std::string to_json(const RefboxSummary& summary) {
  nlohmann::json json = {
      {"referee", nlohmann::json::array()}, {"teams", nlohmann::json::array()}, {"faults", nlohmann::json::array()}};
  const auto add_faults = [&](const std::string& file, const imports::FaultCounter& faults) {
    for (nlohmann::json& fault : json_of_faults(file, faults)) json["faults"].push_back(std::move(fault));
  };
  for (const RefereeSummary& game : summary.referee) {
    json["referee"].push_back(json_of_game(game));
    add_faults(game.log->file, game.log->faults);
  }
  for (const TeamSummary& team : summary.teams) {
    json["teams"].push_back(json_of_team(team));
    add_faults(team.team->log.file, team.team->log.faults);
  }
  return json.dump(2, ' ', true, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace trivela::cli
