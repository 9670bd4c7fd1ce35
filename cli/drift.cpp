#include <string>
#include <vector>

#include "cli/options/output.hpp"
#include "cli/verbs.hpp"
#include "evaluator/drift_report/log_drift.hpp"

namespace trivela::cli {

namespace {

struct DriftArguments {
  std::vector<std::string> logs;
  bool json = false;
};

int run_drift(const DriftArguments& arguments) {
  const auto report = evaluator::drift_in({arguments.logs.begin(), arguments.logs.end()});
  say(arguments.json ? to_json(report) : to_text(report));
  for (const std::string& remark : report.remarks) warn(remark);
  return report.found() ? kDoneWithLoss : kDone;
}

}  // namespace

void add_drift(CLI::App& app, int& exit_code) {
  const auto [verb, arguments] = add_verb(
      app, exit_code, "drift", "Say whether a robot's kicker changed, at which kick, and by how much", run_drift);
  verb->footer(
      R"(Exit speeds and crossing heights are compared with what the robot predicted, by CUSUM; the robot's own numbers
alone are used. A robot's kicks go on from log to log, in the order of their time; a simulated session is a
kicker of its own. Exit code 3 where a kicker changed.)");
  verb->add_option("logs", arguments->logs, "Match logs, such as out/match.db")->required();
  verb->add_flag("--json", arguments->json, "JSON instead of text");
}

}  // namespace trivela::cli
