#include "experiment/study/study.hpp"

#include <fmt/format.h>

#include <utility>

#include "config/scenario/scenario.hpp"
#include "experiment/run/arms.hpp"

namespace trivela::experiment {

StudyReport report_of(const Study& study, std::vector<StudyRow> rows, const StudyPlayed& played) {
  StudyAnswer answer = study.answer(study, rows, played);
  StudyReport report{.text = heading(played, study.whom) + table_of(rows, study.changes, played) + answer.text,
                     .csv = csv_of(rows, study.changes, played),
                     .json = json_of(study.name, rows, study.changes, played),
                     .svg = std::move(answer.svg)};
  report.json.update(answer.more);
  return report;
}

std::string arguments_of(const Study& study) {
  const StudyWorld& first = study.worlds.front();
  std::string text = config::to_toml_text(first.scenario);
  for (const Arm& arm : first.arms) text += "\n### arm\n" + describe(arm);
  const auto usual = config::scenario_values(first.scenario);
  for (const StudyWorld& world : study.worlds) {
    text += fmt::format("\n### {}\n", world.what);
    for (const Arm& arm : world.arms) text += arm.name + '\n';
    for (const auto& [key, value] : config::scenario_values(world.scenario))
      if (const auto known = usual.find(key); known == usual.end() || known->second != value)
        text += fmt::format("{} = {}\n", key, value);
  }
  return text;
}

}  // namespace trivela::experiment
