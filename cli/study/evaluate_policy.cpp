#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "cli/options/output.hpp"
#include "cli/study/study.hpp"
#include "evaluator/value/policy_value.hpp"

namespace trivela::cli {
namespace {

struct EvaluatePolicyArguments {
  std::vector<std::string> logs;
  std::string policy;
  std::string outcome = "observed";
  bool json = false;
  bool all = false;
};

}  // namespace

void add_evaluate_policy(CLI::App& study, int& exit_code) {
  auto* const verb = study.add_subcommand(
      "evaluate-policy", "What a policy would have had, from logs whose policy was drawn by possession");
  const auto arguments = std::make_shared<EvaluatePolicyArguments>();
  verb->add_option("logs", arguments->logs, "Match logs; their sessions are taken together")
      ->type_name("DB")
      ->required();
  verb->add_option("--policy", arguments->policy, "The policy to value, such as predictive")->required();
  verb->add_option("--outcome", arguments->outcome, "observed: as the robots saw it; truth: the simulator's (observed)")
      ->check(CLI::IsMember({"observed", "truth"}));
  verb->add_flag("--json", arguments->json, "JSON instead of text");
  verb->add_flag("--all", arguments->all, "Every estimate and what they rest on, after the one sentence");
  verb->callback([arguments, &exit_code] {
    const bool truth = arguments->outcome == "truth";
    const auto logged = evaluator::read_opportunities({arguments->logs.begin(), arguments->logs.end()}, truth);
    const auto report = evaluator::evaluate_policy(logged, arguments->policy, truth);
    arguments->json ? fmt::print("{}", evaluator::to_json(report))
                    : say(arguments->all ? evaluator::to_text(report) : evaluator::to_short_text(report));
    exit_code = kDone;
  });
}

}  // namespace trivela::cli
