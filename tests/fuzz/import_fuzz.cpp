// Any bytes as a log of the referee box: a text log, or a team's log with its times and possessions.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "evaluator/imports/play_statistics.hpp"
#include "evaluator/imports/referee_log.hpp"
#include "evaluator/imports/team_log.hpp"

namespace {

using namespace trivela::evaluator::imports;

void require(bool holds) {
  if (!holds) std::abort();
}

RefereeLog read_text(const std::string& text) {
  std::istringstream in(text);
  RefereeLog log = read_referee_log(in, "x.msl");
  for (std::size_t i = 1; i < log.lines.size(); ++i) require(log.lines[i].t_ms >= log.lines[i - 1].t_ms);
  const PlayStatistics statistics = play_statistics(log);
  for (const Play& play : statistics.plays) require(play.to_ms >= play.from_ms);
  require(!log.lines.empty() || !log.faults.sentences().empty());
  return log;
}

void read_team(const std::string& text, const RefereeLog& referee) {
  std::istringstream in(text);
  const TeamLog log = read_team_log(in, "x.A.msl");
  require(static_cast<std::int64_t>(log.usable.size()) <= log.records);
  for (const TeamRecord& record : log.usable) {
    for (const ReportedRobot& robot : record.robots)
      require(robot.id >= 0 && robot.id <= 255 && std::abs(robot.x_m) <= 50.0 && std::abs(robot.heading_rad) < 3.2);
  }
  const auto times_ms = record_times_ms(log, &referee);
  require(times_ms.size() == log.usable.size());
  for (std::size_t i = 1; i < times_ms.size(); ++i) require(times_ms[i] >= times_ms[i - 1]);
  for (const Possession& possession : possessions(log, times_ms)) require(possession.duration_s() >= 0.3);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(bytes), size);
  const auto split = text.find('\1');  // text log, team's log
  const RefereeLog referee = read_text(text.substr(0, split));
  read_team(split == std::string::npos ? text : text.substr(split + 1), referee);
  return 0;
}
