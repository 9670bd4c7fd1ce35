#include "evaluator/counting/arms.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>
#include <tuple>

namespace trivela::evaluator {
namespace {

using Setup = std::tuple<std::uint32_t, std::uint32_t, std::string>;  // world, settings (0: a calibration's), table

Setup setup_of(const ComparedSession& session) {
  return {session.setup.world, session.calibration_id ? 0 : session.setup.settings + 1, session.table};
}

Arm arm_of(const ComparedSession& session, const log::RecordedSession& recorded, const std::string& log) {
  return {.name = session.arm,
          .log = log,
          .scenario = session.scenario,
          .table = session.table,
          .policies = recorded.policies,
          .software_version = recorded.software_version,
          .config_sha256 = session.config_sha256};
}

std::string apart_sentence(const std::string& name, const std::vector<Arm>& all) {
  std::vector<std::string> where;
  for (const Arm& arm : all) {
    if (arm.name == name || arm.name.starts_with(name + " ("))
      where.push_back(fmt::format("{} in {}", arm.name, arm.log));
  }
  return fmt::format("the arm '{}' was played with different settings, tables or worlds, which are not added up: {}",
                     name, fmt::join(where, ", "));
}

}  // namespace

Arms arms_of(const LoggedOpportunities& logged, const std::vector<log::RecordedSession>& recorded) {
  std::map<std::int64_t, const log::RecordedSession*> by_id;
  for (const log::RecordedSession& session : recorded) by_id[session.session_id] = &session;
  Arms arms;
  std::map<std::string, std::map<Setup, std::size_t>> places;  // by name
  std::vector<std::set<std::string>> configurations;
  std::vector<std::set<std::uint32_t>> matches;
  for (const ComparedSession& session : logged.sessions) {
    if (session.arm.empty() || !session.counts) continue;
    auto& of_name = places[session.arm];
    const auto [place, fresh] = of_name.try_emplace(setup_of(session), arms.all.size());
    if (fresh) {
      arms.all.push_back(arm_of(session, *by_id.at(session.session_id), logged.logs[session.log]));
      if (of_name.size() > 1) arms.all.back().name += fmt::format(" ({})", of_name.size());
      configurations.emplace_back();
      matches.emplace_back();
    }
    arms.of_session[session.session_id] = place->second;
    ++arms.all[place->second].sessions;
    configurations[place->second].insert(session.config_sha256);
    matches[place->second].insert(session.match);
  }
  for (std::size_t i = 0; i < arms.all.size(); ++i) {
    arms.all[i].configurations = static_cast<std::int64_t>(configurations[i].size());
    arms.all[i].matches = static_cast<std::int64_t>(matches[i].size());
  }
  for (const auto& [name, setups] : places) {
    if (setups.size() > 1) arms.apart.push_back(apart_sentence(name, arms.all));
  }
  return arms;
}

}  // namespace trivela::evaluator
