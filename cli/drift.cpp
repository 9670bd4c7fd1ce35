#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/options/output.hpp"
#include "cli/verbs.hpp"
#include "evaluator/drift_report/log_drift.hpp"

namespace trivela::cli {

void add_drift(CLI::App& app, int& exit_code) {
  auto* const verb =
      app.add_subcommand("drift", "Say whether a robot's kicker changed, at which kick, and by how much");
  verb->footer(
      "Exit speeds and crossing heights are compared with what the robot predicted, by CUSUM; the robot's own numbers\n"
      "alone are used. A robot's kicks go on from log to log, in the order of their time; a simulated session is a\n"
      "kicker of its own. Exit code 3 where a kicker changed.");
  const auto logs = std::make_shared<std::vector<std::string>>();
  const auto json = std::make_shared<bool>(false);
  verb->add_option("logs", *logs, "Match logs, such as out/match.db")->required();
  verb->add_flag("--json", *json, "JSON instead of text");
  verb->callback([logs, json, &exit_code] {
    const auto report = evaluator::drift_in({logs->begin(), logs->end()});
    if (*json) {
      fmt::print("{}", to_json(report));
    } else {
      say(to_text(report));
    }
    for (const std::string& remark : report.remarks) warn(remark);
    exit_code = report.found() ? kDoneWithLoss : kDone;
  });
}

}  // namespace trivela::cli
